function starter(case_id, elements, step)
% A chain of point masses, axial springs and rotational springs takes part in case S1.
%
%   starter S1 16 1e-4                       in MATLAB and Octave
%   octave --path starters/matlab --eval "starter S1 16 1e-4"        from a shell
%
% writes S1/m016_h1e-4.csv and a row of runs.csv in the folder where it is run. Nodes 0 to n stand
% L/n apart, as complex numbers z = x + iy in the frame that turns with the clamp; steps are
% leapfrog's.
  L = 8.0; EA = 5.0326605e6; EI = 566.3553; rho_A = 0.20196333;  % of S1, as in cases.csv
  omega = 6.0; T = 3.0; duration = 15.0;

  n = str2double(elements); h = str2double(step); started = tic;
  l = L / n; longest = l * sqrt(rho_A / EA);
  if ~strcmp(case_id, 'S1')
    error('this starter knows case S1, not %s: add it from cases.csv', case_id);
  end
  if ~(h > 0 && h <= longest)
    error('with %d elements the step must be at most %.1e s, or waves along run away', n, longest);
  end
  mass = rho_A * l * ones(n, 1); mass(end) = mass(end) / 2;
  z = (0:n)' * l; v = zeros(n, 1);
  every = max(1, floor(0.01 / h + 1e-9)); steps = ceil(duration / h - 1e-9);
  rows = zeros(floor(steps / every) + 2, 3); count = 0;
  for k = 0:steps
    t = k * h;
    if t < T                               % theta' and theta'' of Eq. 1
      w = omega / T * (t - T / (2 * pi) * sin(2 * pi * t / T));
      w_dot = omega / T * (1 - cos(2 * pi * t / T));
    else
      w = omega; w_dot = 0;
    end
    before = imag(v(end));
    a = spring_forces(z, l, EA, EI) ./ mass + (w^2 - 1i * w_dot) * z(2:end);
    v = ((1 - 1i * w * h) * v + h * a) / (1 + 1i * w * h);  % Coriolis' force of both half steps
    if mod(k, every) == 0 || k == steps
      count = count + 1;
      rows(count, :) = [t, imag(z(end)), (before + imag(v(end))) / 2];
    end
    z(2:end) = z(2:end) + h * v;
  end

  name = sprintf('S1/m%03d_h%s.csv', n, step);
  if ~exist('S1', 'dir'), mkdir('S1'); end
  file = fopen(name, 'w');
  fprintf(file, 'time,q,q_dot\n');
  fprintf(file, '%.17g,%.17g,%.17g\n', rows(1:count, :)');
  fclose(file);
  is_new = ~exist('runs.csv', 'file');
  file = fopen('runs.csv', 'a');
  if is_new, fprintf(file, 'file,elements,dof,step,wall_s\n'); end
  fprintf(file, '%s,%d,%d,%s,%.6g\n', name, n, 2 * n, step, toc(started));
  fclose(file);
end

function force = spring_forces(z, l, EA, EI)
% Forces on nodes 1 to n, of springs EA/l along links and EI/l between them. The clamp is half a
% link away from the first one, hence a spring twice as stiff.
  d = diff(z); s = abs(d);
  bend = EI / l * [2 * angle(d(1)); angle(d(2:end) .* conj(d(1:end-1))); 0];
  push = EA / l * (s - l) .* d ./ s + (bend(1:end-1) - bend(2:end)) .* (1i * d) ./ s.^2;
  force = [push(2:end); 0] - push;
end
