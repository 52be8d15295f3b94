"""What each figure of the paper claims, and what is true."""

CAPTIONS: dict[int, str] = {
    3: (
        "Tip displacement with one, two and three elements. The paper: even one element is "
        "stable. So it is, here with Exudyn's cable; the phase of the steady oscillation takes two."
    ),
    4: (
        "Steady orbits in the normalization of Eqs. 15, 17 and 18, Eq. 18 corrected: "
        "q̇₀ = q₀√(EI/mL³ + ω²). The paper: orbits of large amplitude are distorted. So they are."
    ),
    5: (
        "Frequency against amplitude of the finite element model, 16 elements at a step of 1 ms, "
        "ω_n from the mesh's own linear frequencies; bars of step, mesh and estimator are smaller "
        "than the symbols. The paper: nearly quadratic. Up to a = 0.4 it is; through all points a "
        "parabola misses most, and its λ_ω is a third to a half too large at 6 and 8 rad/s. The "
        "curves are 1 - λ_ω a² - κ a⁴, fitted below a = 0.6: within 1.5 % of the exact -0.0090, "
        "0.0087, 0.0197, 0.0238. λ_ω changes sign between 2 and 4 rad/s."
    ),
    8: (
        "Backbones of the inextensible model CI. The paper: all lie in the shaded area. As algebra "
        "of the model they do; the model softens far too much, because Eq. 25 drops -v'⁴/8."
    ),
    9: (
        "λ_ω and λ_x of CI. The paper: softening grows with speed. True of the model, and an "
        "artifact of Eq. 25."
    ),
    10: (
        "Polynomial shapes against the cantilever's mode. The paper: degree 5 is nearest at low "
        "speed, and degree 4 never hardens. Reproduced."
    ),
    11: (
        "The extensible model CE for several slendernesses; the print does not say which. "
        "Reproduced in shape; the elongation by a sine is an assumption."
    ),
    12: (
        "Convergence of Frobenius' series, Eq. 81 corrected. The paper: degree 36 is enough. At "
        "8 rad/s it is 2.1e-4 rad/s off."
    ),
    13: "First mode shape at rest and in rotation. The paper: they differ with speed. They do.",
    14: (
        "Backbones of the paper's models (CI, CE, FrI, FrE), of ours (FrC, FrM) and of the exact "
        "beam, with finite element points: 16 elements as in the paper, and 64 elements "
        "extrapolated to a step of zero. The paper: extensibility is what makes FrE right. In "
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
        "One period of the finite element orbit, 16 elements at a step of 1 ms, and of the models "
        "at the same peak amplitude; dots mark where each ends. The paper: FrI is noticeably close "
        "but open, its frequency too low; CI and CE are significantly inaccurate. The print does "
        "not say which T. At T = 3.375 and 3.25 s (a = 0.20, 0.23) the paper's order of the paths "
        "holds: FrI strays 3.0 and 3.5 % of the half axes, CI 4.3 and 4.0 %, CE 6 %. From T = 3 s "
        "on (a = 0.32) it does not: FrI strays 6.2 % and misses its start by 35 %, CI only 2.3 and "
        "7.5 %, as its too high ω_n and too strong softening cancel. FrI's frequency is too low "
        "at every T. FrM, FrC and FrE close to 1.3 %. All three stray 2 % from the exact orbit, "
        "which is a little lower: the second harmonic, which Coriolis forces bring and Eq. 65 "
        "has not."
    ),
}
