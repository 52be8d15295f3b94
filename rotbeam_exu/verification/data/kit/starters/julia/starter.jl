# A chain of point masses, axial springs and rotational springs takes part in case S1.
#
#     julia starter.jl S1 16 1e-4
#
# writes S1/m016_h1e-4.csv and a row of runs.csv in the folder where it is run. Nodes 0 to n stand
# L/n apart, as complex numbers z = x + iy in the frame that turns with the clamp; steps are
# leapfrog's.

const L, EA, EI, RHO_A = 8.0, 5.0326605e6, 566.3553, 0.20196333  # of S1, as in cases.csv
const OMEGA, T, DURATION = 6.0, 3.0, 15.0

# θ' and θ'' of Eq. 1
rate(t) = t < T ? OMEGA / T * (t - T / 2π * sin(2π * t / T)) : OMEGA
acceleration(t) = t < T ? OMEGA / T * (1 - cos(2π * t / T)) : 0.0

# Forces on nodes 1 to n, of springs EA/l along links and EI/l between them. The clamp is half a
# link away from the first one, hence a spring twice as stiff.
function spring_forces(z, l)
    d = diff(z)
    s = abs.(d)
    bend = EI / l .* [2 * angle(d[1]); angle.(d[2:end] .* conj.(d[1:end-1])); 0.0]
    push = EA / l .* (s .- l) .* d ./ s .+ (bend[1:end-1] .- bend[2:end]) .* im .* d ./ s .^ 2
    return [push[2:end]; 0.0] .- push
end

function history(n, h)
    l = L / n
    mass = fill(RHO_A * l, n)
    mass[end] /= 2
    z, v = complex.(l .* (0:n)), zeros(ComplexF64, n)
    every, steps = max(1, floor(Int, 0.01 / h + 1e-9)), ceil(Int, DURATION / h - 1e-9)
    rows = Tuple{Float64,Float64,Float64}[]
    for k in 0:steps
        t = k * h
        w, before = rate(t), imag(v[end])
        a = spring_forces(z, l) ./ mass .+ (w^2 - im * acceleration(t)) .* z[2:end]
        v = ((1 - im * w * h) .* v .+ h .* a) ./ (1 + im * w * h)  # Coriolis' force of both half steps
        (k % every == 0 || k == steps) && push!(rows, (t, imag(z[end]), (before + imag(v[end])) / 2))
        z[2:end] .+= h .* v
    end
    return rows
end

function main(case, elements, step)
    n, h, started = parse(Int, elements), parse(Float64, step), time()
    longest = L / n * sqrt(RHO_A / EA)
    case == "S1" || error("this starter knows case S1, not $case: add it from cases.csv")
    0 < h <= longest || error("with $n elements the step must be at most $longest s, or waves along run away")
    name = "S1/m$(lpad(n, 3, '0'))_h$step.csv"
    mkpath("S1")
    rows = history(n, h)
    open(name, "w") do file
        println(file, "time,q,q_dot")
        foreach(row -> println(file, join(row, ',')), rows)
    end
    is_new = !isfile("runs.csv")
    open("runs.csv", "a") do file
        is_new && println(file, "file,elements,dof,step,wall_s")
        println(file, join((name, n, 2n, step, time() - started), ','))
    end
end

main(ARGS...)
