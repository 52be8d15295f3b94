! A chain of point masses, axial springs and rotational springs takes part in case S1.
!
!     gfortran -O2 -o starter starter.f90
!     ./starter S1 16 1e-4
!
! writes S1/m016_h1e-4.csv and a row of runs.csv in the folder where it is run. Nodes 0 to n stand
! L/n apart, as complex numbers z = x + iy in the frame that turns with the clamp; steps are
! leapfrog's.
program starter
  implicit none
  integer, parameter :: dp = kind(1.0d0)
  real(dp), parameter :: pi = acos(-1.0_dp)
  complex(dp), parameter :: i = (0.0_dp, 1.0_dp)
  real(dp), parameter :: L = 8.0_dp, EA = 5.0326605e6_dp, EI = 566.3553_dp, rho_A = 0.20196333_dp
  real(dp), parameter :: omega = 6.0_dp, T = 3.0_dp, duration = 15.0_dp  ! of S1, as in cases.csv
  character(len=32) :: case_id, elements, step
  character(len=64) :: name
  complex(dp), allocatable :: z(:), v(:), a(:)
  real(dp), allocatable :: mass(:)
  complex(dp) :: before
  real(dp) :: h, link, longest, now, w, w_dot
  integer :: n, k, every, steps, file, started, ended, ticks
  logical :: known

  call get_command_argument(1, case_id)
  call get_command_argument(2, elements)
  call get_command_argument(3, step)
  call system_clock(started, ticks)
  if (case_id /= 'S1') call stop_with('this starter knows case S1: add others from cases.csv')
  read (elements, *) n
  read (step, *) h
  link = L / n
  longest = link * sqrt(rho_A / EA)
  if (.not. (h > 0 .and. h <= longest)) then
    write (name, '(a,es8.1,a)') 'the step must be at most', longest, ' s, or waves along run away'
    call stop_with(trim(name))
  end if

  allocate (mass(n), v(n), a(n), z(0:n))
  mass = rho_A * link
  mass(n) = mass(n) / 2
  z = [(cmplx(k * link, 0.0_dp, dp), k = 0, n)]
  v = 0
  every = max(1, int(0.01_dp / h + 1e-9_dp))
  steps = ceiling(duration / h - 1e-9_dp)
  call execute_command_line('mkdir -p S1')
  write (name, '(a,i3.3,a)') 'S1/m', n, '_h' // trim(step) // '.csv'
  open (newunit=file, file=name, status='replace', action='write')
  write (file, '(a)') 'time,q,q_dot'
  do k = 0, steps
    now = k * h
    w = omega
    w_dot = 0
    if (now < T) then  ! Eq. 1
      w = omega / T * (now - T / (2 * pi) * sin(2 * pi * now / T))
      w_dot = omega / T * (1 - cos(2 * pi * now / T))
    end if
    before = v(n)
    a = spring_forces() / mass + (w**2 - i * w_dot) * z(1:n)
    v = ((1 - i * w * h) * v + h * a) / (1 + i * w * h)  ! Coriolis' force of both half steps
    if (mod(k, every) == 0 .or. k == steps) &
      write (file, '(es24.16e3,2(",",es24.16e3))') now, aimag(z(n)), aimag(before + v(n)) / 2
    z(1:n) = z(1:n) + h * v
  end do
  close (file)

  call system_clock(ended)
  inquire (file='runs.csv', exist=known)
  open (newunit=file, file='runs.csv', position='append', action='write')
  if (.not. known) write (file, '(a)') 'file,elements,dof,step,wall_s'
  write (file, '(a,",",i0,",",i0,",",a,",",es12.5)') &
    trim(name), n, 2 * n, trim(step), real(ended - started, dp) / ticks
  close (file)

contains

  ! Forces on nodes 1 to n, of springs EA/l along links and EI/l between them. The clamp is half a
  ! link away from the first one, hence a spring twice as stiff.
  function spring_forces() result(force)
    complex(dp) :: force(n), d(n), push(n)
    real(dp) :: s(n), bend(n + 1)
    d = z(1:n) - z(0:n - 1)
    s = abs(d)
    bend(1) = 2 * angle(d(1))
    bend(2:n) = angle(d(2:n) * conjg(d(1:n - 1)))
    bend(n + 1) = 0
    bend = bend * EI / link
    push = EA / link * (s - link) * d / s + (bend(1:n) - bend(2:n + 1)) * i * d / s**2
    force = -push
    force(1:n - 1) = force(1:n - 1) + push(2:n)
  end function

  elemental real(dp) function angle(d)
    complex(dp), intent(in) :: d
    angle = atan2(aimag(d), real(d))
  end function

  subroutine stop_with(text)
    character(len=*), intent(in) :: text
    write (0, '(a)') text
    stop 1
  end subroutine

end program
