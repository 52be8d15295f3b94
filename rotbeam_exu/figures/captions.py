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
        "Frequency against amplitude of the finite element model, ω_n from the mesh's own linear "
        "frequencies, with least-squares parabolas. The paper: nearly quadratic. Below a = 0.4 it "
        "is; λ_ω changes sign between 2 and 4 rad/s."
    ),
    8: (
        "Backbones of the inextensible model CI. The paper: all lie in the shaded area. As algebra "
        "of the model they do; the model softens far too much, because Eq. 25 drops -v'⁴/8."
    ),
    9: (
        "λ_ω and λ_x of CI. The paper: softening grows with speed. True of the model, and an "
        "artefact of Eq. 25."
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
        "truth FrE is nearly right because the sine's excess partly cancels two omissions, "
        "-v'⁴/8 and the Coriolis-coupled modes; FrM has both and is inextensible. Error bars are "
        "smaller than the symbols. CI, CE and FrI leave the frame; so do the points above a = 0.6."
    ),
    15: (
        "One period of the finite element orbit, and of the models at the same peak amplitude. The "
        "paper: FrI stays open because its frequency is too low. So it does; FrM, FrC and FrE "
        "close. The exact orbit is a little lower than theirs: the second harmonic, which Coriolis "
        "forces bring and Eq. 65 has not."
    ),
}
