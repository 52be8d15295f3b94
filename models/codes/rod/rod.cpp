// A rod of cubic Hermite elements, r and r' at the nodes, in the frame that turns with the clamp.
//
//   rod L EA EI rhoA hub tip_mass damping gravity omega T elements, and one of
//   ... history STEP EVERY STEPS    prints q after each EVERY steps of the implicit midpoint rule
//   ... orbit STEP EVERY STEPS      the same from the state in standard input: X Y X' Y' and rates
//   ... frequency                   prints the first natural frequency at omega
//
// A point of the plane is a complex number, r = x + iy. With z = r' and w = r'' the stretch is
// |z| - 1 and the curvature, of the rod's own length, Im(w/z).

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

using C = std::complex<double>;
using Vector = std::vector<double>;  // of node k: x, y, x', y' from 4k on
constexpr int WIDTH = 7;             // of the band on either side: two nodes of four
constexpr C UNIT[2] = {{1, 0}, {0, 1}};
const double POINT[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
const double WEIGHT[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};

struct Band {
  int n;
  Vector a;
  explicit Band(int n) : n(n), a(n * (2 * WIDTH + 1), 0.0) {}
  double& operator()(int i, int j) { return a[i * (2 * WIDTH + 1) + j - i + WIDTH]; }
};

// Gauss without pivots: b becomes A^-1 b. Returns how many pivots are negative.
int solve(Band A, Vector& b) {
  int negative = 0;
  for (int k = 0; k < A.n; ++k) {
    const int end = std::min(A.n, k + WIDTH + 1);
    negative += A(k, k) < 0;
    for (int i = k + 1; i < end; ++i) {
      const double factor = A(i, k) / A(k, k);
      if (factor == 0) continue;
      for (int j = k; j < end; ++j) A(i, j) -= factor * A(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (int k = A.n - 1; k >= 0; --k) {
    for (int j = k + 1; j < std::min(A.n, k + WIDTH + 1); ++j) b[k] -= A(k, j) * b[j];
    b[k] /= A(k, k);
  }
  return negative;
}

struct Rod {
  double L, EA, EI, rhoA, hub, tip, damping, gravity, omega, T;
  int n;
  double l() const { return L / n; }
  int size() const { return 4 * (n + 1); }

  double acceleration(double t) const { return t < T ? omega / T * (1 - std::cos(2 * M_PI * t / T)) : 0; }
  double rate(double t) const { return t < T ? omega / T * (t - T / (2 * M_PI) * std::sin(2 * M_PI * t / T)) : omega; }
  double angle(double t) const {
    const double s = std::min(t, T), wave = T > 0 ? T / M_PI * std::sin(M_PI * s / T) : 0;
    return (T > 0 ? omega / (2 * T) * (s * s - wave * wave) : 0) + omega * (t - s);
  }

  // Hermite's functions of r, r', r, r' (derivative 0), and their derivatives to x.
  void shapes(double s, double (&N)[3][4]) const {
    const double h = l();
    const double table[3][4] = {
        {1 - 3 * s * s + 2 * s * s * s, h * (s - 2 * s * s + s * s * s), 3 * s * s - 2 * s * s * s, h * (s * s * s - s * s)},
        {(6 * s * s - 6 * s) / h, 1 - 4 * s + 3 * s * s, (6 * s - 6 * s * s) / h, 3 * s * s - 2 * s},
        {(12 * s - 6) / h / h, (6 * s - 4) / h, (6 - 12 * s) / h / h, (6 * s - 2) / h}};
    std::memcpy(N, table, sizeof table);
  }

  Vector straight() const {
    Vector u(size(), 0.0);
    for (int k = 0; k <= n; ++k) u[4 * k] = hub + k * l(), u[4 * k + 2] = 1;
    return u;
  }

  Band mass() const {
    Band M(size());
    double N[3][4];
    for (int e = 0; e < n; ++e)
      for (int p = 0; p < 4; ++p) {
        shapes(POINT[p], N);
        for (int i = 0; i < 8; ++i)
          for (int j = i % 2; j < 8; j += 2) M(4 * e + i, 4 * e + j) += WEIGHT[p] * l() * rhoA * N[0][i / 2] * N[0][j / 2];
      }
    for (int i = 0; i < 2; ++i) M(4 * n + i, 4 * n + i) += tip;
    return M;
  }

  // Adds the stresses' forces at u and its rate v, and their derivative if dv = rates du.
  void stresses(const Vector& u, const Vector& v, double rates, Vector& F, Band& K) const {
    double N[3][4];
    for (int e = 0; e < n; ++e)
      for (int p = 0; p < 4; ++p) {
        shapes(POINT[p], N);
        C z, w;
        for (int i = 0; i < 8; ++i) z += u[4 * e + i] * N[1][i / 2] * UNIT[i % 2], w += u[4 * e + i] * N[2][i / 2] * UNIT[i % 2];
        const C one = 1.0 / z, curved = w * one;
        C a[8], b[8], c[8], a_dot, b_dot;  // z and w differentiated, over z
        for (int i = 0; i < 8; ++i) {
          a[i] = N[1][i / 2] * UNIT[i % 2] * one, b[i] = N[2][i / 2] * UNIT[i % 2] * one;
          c[i] = 2.0 * curved * a[i] - b[i];
          a_dot += v[4 * e + i] * a[i], b_dot += v[4 * e + i] * b[i];
        }
        const C c_dot = 2.0 * curved * a_dot - b_dot;
        const double weight = WEIGHT[p] * l(), s = std::abs(z), tension = EA * (s - 1);
        const double moment = EI * (curved + damping * (b_dot - curved * a_dot)).imag();
        double bend[8], bent[8];
        for (int i = 0; i < 8; ++i) {
          bend[i] = (b[i] - curved * a[i]).imag();
          bent[i] = bend[i] * (1 + damping * rates) + damping * (a[i] * c_dot - b[i] * a_dot).imag();
          F[4 * e + i] += weight * (tension * s * a[i].real() + moment * bend[i]);
        }
        for (int i = 0; i < 8; ++i)
          for (int j = 0; j < 8; ++j) {
            const double along = a[i].real() * a[j].real(), across = a[i].imag() * a[j].imag();
            const double bend2 = a[i].real() * c[j].imag() + a[i].imag() * c[j].real() - b[i].real() * a[j].imag() - b[i].imag() * a[j].real();
            K(4 * e + i, 4 * e + j) += weight * (EA * s * s * along + tension * s * across + EI * bend[i] * bent[j] + moment * bend2);
          }
      }
  }

  // The clamp holds x, y and y'; the stretch x' is free.
  void clamp(Band& A, Vector& F) const {
    for (int i : {0, 1, 3}) {
      for (int j = 0; j <= WIDTH; ++j) A(i, j) = A(j, i) = i == j;
      F[i] = 0;
    }
  }

  // One step of the midpoint rule from t to t + h.
  void advance(double t, double h, Band& M, Vector& u, Vector& v) const {
    const double w = rate(t + h / 2), w_dot = acceleration(t + h / 2), two = 2 / h;
    const C weight = -C(0, gravity) * std::polar(1.0, -angle(t + h / 2));
    Vector middle = u, speed = v;
    for (int i = 0; i < size(); ++i) middle[i] += h / 2 * v[i];
    for (int iteration = 0;; ++iteration) {
      if (iteration == 30) throw t;
      Band K(size());
      Vector F(size(), 0.0), load(size(), 0.0);
      stresses(middle, speed, two, F, K);
      for (int i = 0; i < size(); ++i)
        for (int j = std::max(0, i - WIDTH); j < std::min(size(), i + WIDTH + 1); ++j) {
          const double m = M(i, j), side = i % 2 ? 1 : -1;  // of ir = -y + ix
          if (m == 0) continue;
          const int other = i % 2 ? j - 1 : j + 1;
          F[i] += m * (two * (speed[j] - v[j]) + side * (2 * w * speed[other] + w_dot * middle[other]) - w * w * middle[j]);
          K(i, j) += m * (two * two - w * w);
          K(i, other) += m * side * (2 * w * two + w_dot);
        }
      double N[3][4];
      for (int e = 0; e < n; ++e)
        for (int p = 0; p < 4; ++p) {
          shapes(POINT[p], N);
          for (int i = 0; i < 8; ++i) load[4 * e + i] += WEIGHT[p] * l() * rhoA * N[0][i / 2] * (i % 2 ? weight.imag() : weight.real());
        }
      load[4 * n] += tip * weight.real(), load[4 * n + 1] += tip * weight.imag();
      for (int i = 0; i < size(); ++i) F[i] = load[i] - F[i];
      clamp(K, F);
      solve(K, F);
      double change = 0;
      for (int i = 0; i < size(); ++i) middle[i] += F[i], speed[i] += two * F[i], change = std::max(change, std::abs(F[i]));
      if (change < 1e-12 * L) break;
    }
    for (int i = 0; i < size(); ++i) u[i] += h * speed[i], v[i] = 2 * speed[i] - v[i];
  }

  // Below the first natural frequency about the steady state the matrix has no negative pivot.
  double frequency() const {
    Vector u = straight(), rest(size(), 0.0);
    Band M = mass(), K(size());
    auto tangent = [&](double nu, Vector& F) {
      Band A(size());
      F.assign(size(), 0.0);
      stresses(u, rest, 0, F, A);
      for (int i = 0; i < size(); ++i)
        for (int j = std::max(0, i - WIDTH); j < std::min(size(), i + WIDTH + 1); ++j) {
          const double m = M(i, j);
          F[i] -= omega * omega * m * u[j];
          A(i, j) -= (omega * omega + nu * nu) * m;
          if (m != 0) A(i, i % 2 ? j - 1 : j + 1) -= 2 * omega * nu * m;
        }
      for (double& value : F) value = -value;
      clamp(A, F);
      return A;
    };
    Vector F;
    for (int iteration = 0; iteration < 5; ++iteration) {
      Band A = tangent(0, F);
      solve(A, F);
      for (int i = 0; i < size(); ++i) u[i] += F[i];
    }
    double low = 0, high = 10 * std::sqrt(EI / rhoA) / (L * L) + 2 * omega;
    while (high - low > 1e-13 * high) {
      const double nu = (low + high) / 2;
      Band A = tangent(nu, F);
      (solve(A, F) ? high : low) = nu;
    }
    return low;
  }
};

int main(int count, char** words) try {
  auto number = [&](int k) { return std::atof(words[k]); };
  if (count < 13) return std::fprintf(stderr, "see the source for its use\n"), 2;
  Rod rod{number(1), number(2), number(3), number(4), number(5), number(6), number(7), number(8), number(9), number(10), std::atoi(words[11])};
  if (std::string(words[12]) == "frequency") return std::printf("%.14g\n", rod.frequency()), 0;
  const double h = number(13);
  Vector u = rod.straight(), v(u.size(), 0.0);
  if (std::string(words[12]) == "orbit")
    for (int k = 0; k <= rod.n; ++k) {
      for (int i = 0; i < 4; ++i) std::cin >> u[4 * k + i];
      for (int i = 0; i < 4; ++i) std::cin >> v[4 * k + i];
    }
  Band M = rod.mass();
  for (int k = 0;; ++k) {
    if (k % std::atoi(words[14]) == 0) std::printf("%.14g\n", u[4 * rod.n + 1]);
    if (k == std::atoi(words[15])) break;
    rod.advance(k * h, h, M, u, v);
  }
} catch (double t) {
  std::fprintf(stderr, "Newton's method fails at %.4g s\n", t);
  return 1;
}
