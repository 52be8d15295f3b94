# GXBeam takes part in cases S1 to S4. Written from its documentation and its sources (commit
# 8541187, March 2026), and not run yet: the authors of the benchmark have no Julia.
#
#     julia -e 'using Pkg; Pkg.add("GXBeam")'
#     julia run.jl S1 16 4e-3
#
# writes S1/m016_h4e-3.csv and a row of runs.csv in the folder where it is run. Take three meshes
# and three steps of a case, and fill in entry.toml of the kit's sample.

using GXBeam, LinearAlgebra

const L, EA, EI, RHO_A = 8.0, 5.0326605e6, 566.3553, 0.20196333  # as in cases.csv
const MOTIONS = Dict(  # ω [rad/s], T [s] and the duration [s]
    "S1" => (6.0, 3.0, 15.0), "S2" => (2.0, 3.375, 20.0),
    "S3" => (4.0, 2.0, 15.0), "S4" => (8.0, 2.0, 15.0),
)
const EVERY = 0.01  # [s] between samples at least

# θ' and θ'' of Eq. 1
rate(t, ω, T) = t < T ? ω / T * (t - T / 2π * sin(2π * t / T)) : ω
acceleration(t, ω, T) = t < T ? ω / T * (1 - cos(2π * t / T)) : 0.0

# Shear stiffness 100 EA and a hundredth of the rotary inertia: nearly Bernoulli and Euler's beam.
# Flap and torsion as stiff as lag: the beam stays in its plane.
function beam(n)
    points = [[L * i / n, 0.0, 0.0] for i in 0:n]
    stiffness = fill(Diagonal([EA, 100EA, 100EA, EI, EI, EI]), n)
    slice = 0.01 * RHO_A * EI / EA
    mass = fill(Diagonal([RHO_A, RHO_A, RHO_A, 2slice, slice, slice]), n)
    return Assembly(points, 1:n, 2:n+1; stiffness=stiffness, mass=mass)
end

function history(n, h, ω, T, duration)
    steps = ceil(Int, duration / h - 1e-9)
    every = max(1, floor(Int, EVERY / h + 1e-9))
    kept = unique([1:every:steps+1; steps + 1])
    clamp = Dict(1 => PrescribedConditions(ux=0, uy=0, uz=0, theta_x=0, theta_y=0, theta_z=0))
    _, states, converged = time_domain_analysis(
        beam(n), h .* (0:steps); prescribed_conditions=clamp, structural_damping=false, save=kept,
        # The frame of the body turns with the clamp.
        pfunc=(p, t) -> (;
            angular_velocity=[0.0, 0.0, rate(t, ω, T)],
            angular_acceleration=[0.0, 0.0, acceleration(t, ω, T)],
        ),
    )
    converged || error("a step of $h s with $n elements did not converge")
    return [(h * (k - 1), state.points[end].u[2]) for (k, state) in zip(kept, states)]
end

function main(case, elements, step)
    n, h, started = parse(Int, elements), parse(Float64, step), time()
    haskey(MOTIONS, case) || error("this script knows $(join(sort(collect(keys(MOTIONS))), ", "))")
    name = "$case/m$(lpad(n, 3, '0'))_h$step.csv"
    mkpath(case)
    rows = history(n, h, MOTIONS[case]...)
    open(name, "w") do file
        println(file, "time,q")
        foreach(row -> println(file, join(row, ',')), rows)
    end
    is_new = !isfile("runs.csv")
    open("runs.csv", "a") do file
        is_new && println(file, "file,elements,dof,step,wall_s")
        println(file, join((name, n, 12(n + 1), step, time() - started), ','))
    end
end

main(ARGS...)
