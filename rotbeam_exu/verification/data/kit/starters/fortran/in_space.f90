! A chain of point masses and springs in space takes part in case K, and in S1.
!
!     gfortran -O2 -o in_space in_space.f90
!     ./in_space K 16 1e-4
!
! writes K/m016_h1e-4.csv and a row of runs.csv in the folder where it is run. Nodes 0 to n stand
! L/n apart, at places (x, y, z) along b1, b2, b3, the axes that turn with the clamp; steps are
! leapfrog's. The tube bends alike in all directions, so torsion does no work: sections follow
! without twist.
program in_space
  implicit none
  integer, parameter :: dp = kind(1.0d0)
  real(dp), parameter :: pi = acos(-1.0_dp)
  real(dp), parameter :: L = 8.0_dp, EA = 5.0326605e6_dp, EI = 566.3553_dp, rho_A = 0.20196333_dp
  real(dp), parameter :: omega = 6.0_dp, T = 3.0_dp, duration = 15.0_dp  ! of K and S1
  character(len=32) :: case_id, elements, step
  character(len=64) :: name
  real(dp), allocatable :: r(:, :), u(:, :), v(:, :), a(:, :), mass(:), s(:)
  real(dp) :: h, dt, link, longest, now, w, w_dot, c, p, q, x
  integer :: n, k, i, every, steps, file, started, ended, ticks
  logical :: known

  call get_command_argument(1, case_id)
  call get_command_argument(2, elements)
  call get_command_argument(3, step)
  call system_clock(started, ticks)
  if (case_id /= 'K' .and. case_id /= 'S1') &
    call stop_with('this starter knows cases K and S1: add others from cases.csv')
  read (elements, *) n
  read (step, *) h
  link = L / n
  longest = link * sqrt(rho_A / EA)
  if (.not. (h > 0 .and. h <= longest)) then
    write (name, '(a,es8.1,a)') 'the step must be at most', longest, ' s, or waves along run away'
    call stop_with(trim(name))
  end if

  allocate (r(3, 0:n), u(3, 0:n), v(3, n), a(3, n), mass(n), s(n))
  mass = rho_A * link
  mass(n) = mass(n) / 2
  r = 0
  v = 0
  do i = 1, n
    x = real(i, dp) / n
    r(1, i) = x * L
    if (case_id == 'K') v(3, i) = 2 * x**2 * (6 - 4 * x + x**2) / 3
  end do
  every = max(1, int(0.01_dp / h + 1e-9_dp))
  steps = ceiling(duration / h - 1e-9_dp)
  call execute_command_line('mkdir -p ' // trim(case_id))
  write (name, '(a,i3.3,a)') trim(case_id) // '/m', n, '_h' // trim(step) // '.csv'
  open (newunit=file, file=name, status='replace', action='write')
  if (case_id == 'K') then
    write (file, '(a)') 'time,lag,flap,twist'
  else
    write (file, '(a)') 'time,q'
  end if
  do k = 0, steps
    now = k * h
    if (mod(k, every) == 0 .or. k == steps) then
      if (case_id == 'K') then
        write (file, '(es24.16e3,3(",",es24.16e3))') now, r(2, n), r(3, n), twist()
      else
        write (file, '(es24.16e3,",",es24.16e3)') now, r(2, n)
      end if
    end if
    w = omega
    w_dot = 0
    if (now < T) then  ! Eq. 1
      w = omega / T * (now - T / (2 * pi) * sin(2 * pi * now / T))
      w_dot = omega / T * (1 - cos(2 * pi * now / T))
    end if
    a = spring_forces()
    dt = h
    if (k == 0) dt = h / 2  ! the first step starts from the velocity at t = 0
    c = w * dt
    do i = 1, n
      a(:, i) = a(:, i) / mass(i)
      a(1, i) = a(1, i) + w**2 * r(1, i) + w_dot * r(2, i)
      a(2, i) = a(2, i) + w**2 * r(2, i) - w_dot * r(1, i)
      ! Coriolis' force 2 w (v_y, -v_x), half of it with the velocity after the step.
      p = v(1, i) + c * v(2, i) + dt * a(1, i)
      q = v(2, i) - c * v(1, i) + dt * a(2, i)
      v(1, i) = (p + c * q) / (1 + c**2)
      v(2, i) = (q - c * p) / (1 + c**2)
      v(3, i) = v(3, i) + dt * a(3, i)
      r(:, i) = r(:, i) + h * v(:, i)
    end do
  end do
  close (file)

  call system_clock(ended)
  inquire (file='runs.csv', exist=known)
  open (newunit=file, file='runs.csv', position='append', action='write')
  if (.not. known) write (file, '(a)') 'file,elements,dof,step,wall_s'
  write (file, '(a,",",i0,",",i0,",",a,",",es12.5)') &
    trim(name), n, 3 * n, trim(step), real(ended - started, dp) / ticks
  close (file)

contains

  ! Set lengths s and directions u of the links, the clamp's direction first.
  subroutine set_links()
    integer :: j
    u(:, 0) = [1.0_dp, 0.0_dp, 0.0_dp]
    do j = 1, n
      u(:, j) = r(:, j) - r(:, j - 1)
      s(j) = norm2(u(:, j))
      u(:, j) = u(:, j) / s(j)
    end do
  end subroutine

  ! Forces on nodes 1 to n, of springs EA/l along links and EI/l between them. The clamp is half a
  ! link away from the first one, hence a spring twice as stiff.
  function spring_forces() result(force)
    real(dp) :: force(3, n), moment(3, n + 1), push(3), sine
    integer :: j
    call set_links()
    do j = 1, n
      moment(:, j) = EI / link * cross(u(:, j - 1), u(:, j))
      sine = norm2(cross(u(:, j - 1), u(:, j)))
      if (sine > 1e-9_dp) &
        moment(:, j) = moment(:, j) * atan2(sine, dot_product(u(:, j - 1), u(:, j))) / sine
    end do
    moment(:, 1) = 2 * moment(:, 1)
    moment(:, n + 1) = 0
    force = 0
    do j = 1, n
      push = EA / link * (s(j) - link) * u(:, j) &
        + cross(moment(:, j) - moment(:, j + 1), u(:, j)) / s(j)
      force(:, j) = force(:, j) - push
      if (j > 1) force(:, j - 1) = force(:, j - 1) + push
    end do
  end function

  ! The twist of the tip: b2 and b3 are carried from link to link without twist.
  real(dp) function twist()
    real(dp) :: b(3, 2)
    integer :: j, m
    call set_links()
    b = reshape([0, 1, 0, 0, 0, 1], [3, 2])
    do j = 1, n
      do m = 1, 2
        b(:, m) = b(:, m) - (u(:, j - 1) + u(:, j)) * dot_product(b(:, m), u(:, j)) &
          / (1 + dot_product(u(:, j - 1), u(:, j)))
      end do
    end do
    twist = atan2(b(3, 1), b(3, 2))
  end function

  pure function cross(d, e)
    real(dp), intent(in) :: d(3), e(3)
    real(dp) :: cross(3)
    cross = [d(2) * e(3) - d(3) * e(2), d(3) * e(1) - d(1) * e(3), d(1) * e(2) - d(2) * e(1)]
  end function

  subroutine stop_with(text)
    character(len=*), intent(in) :: text
    write (0, '(a)') text
    stop 1
  end subroutine

end program
