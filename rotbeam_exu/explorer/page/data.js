// What the page shows, unpacked, and the models' formulas.

function unpack({dtype, data}) {
  const bytes = Uint8Array.from(atob(data), c => c.charCodeAt(0));
  return new ({float64: Float64Array, float32: Float32Array, int16: Int16Array}[dtype])(bytes.buffer);
}
const D = {}, SHAPE = {};
for (const [name, packed] of Object.entries(DATA.arrays)) { D[name] = unpack(packed); SHAPE[name] = packed.shape; }
const W = D.omega.length, A = D.a.length;
const LARGEST = D.a[A - 1], FASTEST = D.omega[W - 1], PAPER_BOUND = 0.2;

const ABOUT = {
  exact: "periodic orbits of the geometrically exact beam", CI: "cantilever mode, inextensible (paper)",
  CE: "cantilever mode, extensible (paper)", FrI: "rotating mode, inextensible (paper)",
  FrE: "rotating mode, extensible (paper)", FrC: "rotating mode, consistent foreshortening",
  FrM: "FrC with the Coriolis coupling to all other bending modes", FrM5: "FrM with the fifth order of the frequency", P3: "polynomial of degree 3, inextensible (paper)",
  P4: "polynomial of degree 4, inextensible (paper)", P5: "polynomial of degree 5, inextensible (paper)",
};
const ORDER = ["exact", "FrM5", "FrM", "FrC", "FrE", "FrI", "CE", "CI", "P3", "P4", "P5"].filter(m => m === "exact" || DATA.models.includes(m));
for (const m of DATA.models) if (!ORDER.includes(m)) ORDER.push(m);
const ROW = Object.fromEntries(DATA.models.map((m, i) => [m, i]));

const linear = (m, w) => m === "exact" ? D.exact_omega_n[w] : D.omega_n[ROW[m] * W + w];
const lambda = (m, w) => m === "exact" ? D.exact_lambda_omega[w] : D.lambda_omega[ROW[m] * W + w];
const exactFrequency = (w, i) => i < 0 ? D.exact_omega_n[w] : D.exact_frequency[w * A + i];
/** The first harmonic of Eq. 65 whose peak the amplitude is. */
const firstHarmonic = (m, w, i) => i < 0 ? 0 : D.first_harmonic[(ROW[m] * W + w) * A + i];
/** Eq. 63, and FrM5's; the exact one from the table. `i` counts amplitudes, -1 is a = 0. */
function frequency(m, w, i) {
  if (m === "exact") return exactFrequency(w, i);
  const a = firstHarmonic(m, w, i), f = linear(m, w) * (1 - lambda(m, w) * a * a - D.kappa[ROW[m] * W + w] * a ** 4);
  return f > 0 ? f : NaN;
}
/** x and dx/dτ of the reduced models, Eq. 65, at the phase ψ of the first harmonic. */
function modelState(m, w, i, psi) {
  const a = firstHarmonic(m, w, i), row = ROW[m] * W + w, rate = frequency(m, w, i) / DATA.frequencyScale;
  const second = D.h2[row] * a ** 2, third = D.lambda_x[row] * a ** 3;
  return [a * Math.cos(psi) - second * Math.sin(2 * psi) - third * Math.cos(3 * psi),
    -rate * (a * Math.sin(psi) + 2 * second * Math.cos(2 * psi) - 3 * third * Math.sin(3 * psi))];
}
/** The same of the exact orbit, from its harmonics; at phase 0 the beam is straight and q rises. */
function exactState(w, i, phase) {
  const H = SHAPE.harmonics[2], start = (w * A + i) * H, rate = exactFrequency(w, i) / DATA.frequencyScale;
  let x = 0, v = 0;
  for (let k = 1; k <= H; k++) {
    const s = D.harmonics[start + k - 1];
    x += s * Math.sin(k * phase); v += s * k * Math.cos(k * phase);
  }
  return [x, rate * v];
}
const LAST = SHAPE.axis_x[3] - 1;
/** Points of the deflected beam, over L, in the rotating frame; from the clamp, or a later one, to the tip. */
function beamAxis(w, i, phase, from = 0) {
  const [, , K, P] = SHAPE.axis_x, start = (w * A + i) * K * P, points = [];
  const cos = [], sin = [];
  for (let k = 0; k < K; k++) { cos.push(DATA.step * Math.cos(k * phase)); sin.push(DATA.step * Math.sin(k * phase)); }
  for (let p = from; p < P; p++) {
    let x = D.axis_x[start + p] === DATA.unknown ? NaN : 0, y = x;  // no orbit was found
    for (let k = 0; k < K; k++) { x += cos[k] * D.axis_x[start + k * P + p]; y += sin[k] * D.axis_y[start + k * P + p]; }
    points.push([x, y]);
  }
  return points;
}
