"""What each figure of the paper claims, and what is true; `descriptions` says what it shows."""

CAPTIONS: dict[int, str] = {
    3: (
        "The paper: even one element is stable. So it is; the phase of the steady oscillation "
        "takes more."
    ),
    4: "The paper: orbits of large amplitude are distorted. So they are.",
    5: (
        "The paper: nearly quadratic. Up to a = 0.4 it is; through all points a "
        "parabola misses most, and its λ_ω is a third to a half too large at 6 and 8 rad/s. The "
        "curves' λ_ω are within 1.5 % of the exact -0.00896, 0.00874, 0.0197, 0.0238. λ_ω changes "
        "sign between 2 and 4 rad/s."
    ),
    8: (
        "The paper: all lie in the shaded area. As algebra of the model they do, and at rest the "
        "model is right; in rotation it softens far too much, because Eq. 25 drops -v'⁴/8."
    ),
    9: (
        "The paper: softening grows with speed. True of the model, and an artifact of Eq. 25: the "
        "exact λ_ω stays below 0.025."
    ),
    10: (
        "The paper: degree 5 is nearest to the mode at low speed, and degree 4 never hardens. "
        "Reproduced; from 4 rad/s on the shape matters little next to the distance from the exact "
        "beam; at rest the mode alone is right."
    ),
    11: (
        "The print does not say which μ it shows. Reproduced in shape; the elongation by a sine is "
        "an assumption, and of a slender beam λ_ω goes the wrong way."
    ),
    12: "The paper: degree 36 is enough. At 8 rad/s it is 2.1e-4 rad/s off. Eq. 81 is corrected.",
    13: "The paper: the difference becomes significant with speed. It does: tension straightens.",
    14: (
        "The paper: extensibility is what makes FrE right. In "
        "fact FrE looks right by one error and one omission: the sine supplies 95 to 97 % of the "
        "-v'⁴/8 that Eq. 25 drops, and what it lacks softens by 1.1 to 1.4 times as much as the "
        "Coriolis-coupled modes, which the model leaves out. FrM has both and is inextensible; no "
        "model here has an a⁴ term, and FrE is the nearer above a = 0.55 at 4 and 6 rad/s, by "
        "luck. Every amplitude is half peak to peak; Eq. 63 is taken at the first harmonic that "
        "has it, up to 2.6 % more for a below 0.6. The paper takes a itself for that harmonic, "
        "which is 0.3 to 5 % of the shift. Bars of step, mesh and estimator are smaller than the "
        "symbols. CI, CE and FrI leave the frame; so do the points above a = 0.6."
    ),
    15: (
        "The paper: FrI is noticeably close "
        "but open, its frequency too low; CI and CE are significantly inaccurate. The print does "
        "not say which T. At T = 3.375 and 3.25 s (a = 0.20, 0.23) the paper's order of the paths "
        "holds: FrI strays 3.0 and 3.4 % of the half axes, CI 4.3 and 3.9 %, CE 6 %. From T = 3 s "
        "on (a = 0.32) it does not: FrI strays 6.2 % and misses its start by 35 %, CI only 2.3 and "
        "7.5 %, as its too high ω_n and too strong softening cancel. FrI's frequency is too low "
        "at every T. At T = 3 s FrM, FrC and FrE close to 1.2 %. FrC and FrE stray 2 %, for they "
        "lack the second harmonic, which Coriolis forces bring; FrM has it and strays 0.2 %."
    ),
}
