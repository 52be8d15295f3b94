// A chain of point masses, axial springs and rotational springs takes part in the benchmark.
//
//   g++ -O2 -std=c++17 -o starter starter.cpp
//   ./starter S1 32 1e-3 [folder of the kit, .. by default]
//
// Any case in the plane but B. Writes S1/m032_h1e-3.csv, or rows of L.csv or TL.csv, in the folder where it is run, and a
// row of runs.csv. Nodes 0 to n stand L/n apart; a spring EA/l joins two of them, a spring EI/l
// bends at each, 2 EI/l at the clamp, from which the first link is half a length away on average;
// all in the frame that turns with the clamp. Steps are those of the implicit midpoint rule.

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Vector = std::vector<double>;
constexpr int WIDTH = 5;  // of the band on either side: a bent node couples three of two unknowns
using Band = std::vector<std::array<double, 2 * WIDTH + 1>>;
double& at(Band& A, int i, int j) { return A[i][j - i + WIDTH]; }

// Gauss without pivots: b becomes A^-1 b. Returns how many pivots are negative.
int solve(Band A, Vector& b) {
  int n = static_cast<int>(b.size()), negative = 0;
  for (int k = 0; k < n; ++k) {
    const double pivot = at(A, k, k);
    negative += pivot < 0.0;
    for (int i = k + 1; i < std::min(n, k + WIDTH + 1); ++i) {
      const double factor = at(A, i, k) / pivot;
      for (int j = k; j < std::min(n, k + WIDTH + 1); ++j) at(A, i, j) -= factor * at(A, k, j);
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < std::min(n, k + WIDTH + 1); ++j) b[k] -= at(A, k, j) * b[j];
    b[k] /= at(A, k, k);
  }
  return negative;
}

struct Table {  // of comma-separated values, by the names in its header
  std::map<std::string, int> column;
  std::vector<std::vector<std::string>> rows;
};

Table table(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file + " is not there: give the folder of the kit");
  Table found;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::istringstream parts(line + ",");
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (found.column.empty())
      for (const auto& name : cells) found.column.emplace(name, static_cast<int>(found.column.size()));
    else
      found.rows.push_back(cells);
  }
  return found;
}

struct Case {  // a row of cases.csv
  std::map<std::string, std::string> cells;
  bool has(const std::string& name) const { return !cells.at(name).empty(); }
  double operator[](const std::string& name) const { return has(name) ? std::stod(cells.at(name)) : 0.0; }
};

Case read_case(const std::string& kit, const std::string& id) {
  const Table cases = table(kit + "/cases.csv");
  for (const auto& row : cases.rows)
    if (row[cases.column.at("id")] == id) {
      Case found;
      for (const auto& [name, place] : cases.column) found.cells[name] = row[place];
      return found;
    }
  throw std::runtime_error("there is no case " + id + " in cases.csv");
}

struct Drive {  // Eq. 1; steady if there is no ramp
  double omega, T;
  double acceleration(double t) const { return t < T ? omega / T * (1 - std::cos(2 * M_PI * t / T)) : 0.0; }
  double rate(double t) const { return t < T ? omega / T * (t - T / (2 * M_PI) * std::sin(2 * M_PI * t / T)) : omega; }
  double angle(double t) const {
    const double s = std::min(t, T), wave = T > 0 ? T / M_PI * std::sin(M_PI * s / T) : 0.0;
    return (T > 0 ? omega / (2 * T) * (s * s - wave * wave) : 0.0) + omega * (t - s);
  }
};

struct Chain {
  int n;
  double l, EA, EI, hub, damping, gravity;
  Vector mass;

  Chain(const Case& c, int elements)
      : n(elements), l(c["L"] / elements), EA(c["EA"]), EI(c["EI"]), hub(c["hub_radius"]),
        damping(c["bending_damping"]), gravity(c["gravity"]), mass(elements, c["rhoA"] * l) {
    mass.back() = c["rhoA"] * l / 2 + c["tip_mass"];
  }

  // Adds the spring forces to F, and their derivative less its sign to K, if v = (2/h)(x - x0).
  void springs(const Vector& x, const Vector& v, double two_over_h, Vector& F, Band& K) const {
    auto node = [&](int k, int i) { return k > 0 ? x[2 * k - 2 + i] : k == 0 && i == 0 ? hub : 0.0; };
    auto add = [&](int first, int nodes, double M, double stiffness, double rate, const double* g, double H[6][6]) {
      for (int i = 0; i < 2 * nodes; ++i) {
        const int row = 2 * (first - 1) + i;
        if (row < 0) continue;
        F[row] -= M * g[i];
        for (int j = 0; j < 2 * nodes; ++j) {
          const int column = 2 * (first - 1) + j;
          if (column < 0) continue;
          double H_v = 0.0;
          if (rate != 0.0)
            for (int k = 0; k < 2 * nodes; ++k) H_v += first - 1 + k / 2 >= 0 ? H[j][k] * v[2 * (first - 1) + k] : 0.0;
          at(K, row, column) += stiffness * g[i] * g[j] + M * H[i][j] + rate * g[i] * H_v;
        }
      }
    };
    for (int k = 0; k < n; ++k) {  // the link from node k to k + 1, stretched by s - l
      const double d[2] = {node(k + 1, 0) - node(k, 0), node(k + 1, 1) - node(k, 1)}, s = std::hypot(d[0], d[1]);
      double g[6] = {-d[0] / s, -d[1] / s, d[0] / s, d[1] / s}, H[6][6] = {};
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) H[i][j] = ((i % 2 == j % 2) * (i / 2 == j / 2 ? 1.0 : -1.0) - g[i] * g[j]) / s;
      add(k, 2, EA / l * (s - l), EA / l, 0.0, g, H);
    }
    for (int k = 0; k < n; ++k) {  // the angle at node k, from link a to link b
      const double a[2] = {k ? node(k, 0) - node(k - 1, 0) : 1.0, k ? node(k, 1) - node(k - 1, 1) : 0.0};
      const double b[2] = {node(k + 1, 0) - node(k, 0), node(k + 1, 1) - node(k, 1)};
      const double aa = a[0] * a[0] + a[1] * a[1], bb = b[0] * b[0] + b[1] * b[1];
      const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
      const double ga[2] = {-a[1] / aa, a[0] / aa}, gb[2] = {-b[1] / bb, b[0] / bb};
      auto second = [](const double* d, double dd, int i, int j) {  // of the angle of d
        return (i == j ? (i ? -2 : 2) * d[0] * d[1] : d[1] * d[1] - d[0] * d[0]) / (dd * dd);
      };
      const double sign_a[3] = {k ? -1.0 : 0.0, k ? 1.0 : 0.0, 0.0}, sign_b[3] = {0.0, -1.0, 1.0};
      double g[6], H[6][6], rate = 0.0;
      for (int i = 0; i < 6; ++i) {
        g[i] = sign_b[i / 2] * gb[i % 2] - sign_a[i / 2] * ga[i % 2];
        for (int j = 0; j < 6; ++j)
          H[i][j] = sign_b[i / 2] * sign_b[j / 2] * second(b, bb, i % 2, j % 2) -
                    sign_a[i / 2] * sign_a[j / 2] * second(a, aa, i % 2, j % 2);
        if (k - 2 + i / 2 >= 0) rate += g[i] * v[2 * (k - 2) + i];
      }
      const double stiffness = (k ? 1 : 2) * EI / l;
      const double moment = stiffness * (angle + damping * rate);
      add(k - 1, 3, moment, stiffness * (1 + damping * two_over_h), stiffness * damping, g, H);
    }
  }

  Vector straight() const {
    Vector x(2 * n, 0.0);
    for (int k = 0; k < n; ++k) x[2 * k] = hub + (k + 1) * l;
    return x;
  }
};

double size(const Vector& x) {
  double largest = 0.0;
  for (double value : x) largest = std::max(largest, std::abs(value));
  return largest;
}

// One step of the midpoint rule from t to t + h.
void advance(const Chain& chain, const Drive& drive, double t, double h, Vector& x, Vector& v) {
  const int n = static_cast<int>(x.size());
  const double half = t + h / 2, w = drive.rate(half), w_dot = drive.acceleration(half), angle = drive.angle(half);
  Vector middle(n), rate = v;
  for (int i = 0; i < n; ++i) middle[i] = x[i] + h / 2 * v[i];
  for (int iteration = 0;; ++iteration) {
    if (iteration == 30)
      throw std::runtime_error("Newton's method fails at t = " + std::to_string(t) + " s: halve the step");
    Band A(n, std::array<double, 2 * WIDTH + 1>{});
    Vector F(n, 0.0);
    chain.springs(middle, rate, 2 / h, F, A);
    for (int i = 0; i < n; ++i) {
      const double m = chain.mass[i / 2], turn = i % 2 ? -1.0 : 1.0;
      const int other = i % 2 ? i - 1 : i + 1;
      F[i] += m * (w * w * middle[i] + turn * (2 * w * rate[other] + w_dot * middle[other]) -
                   chain.gravity * (i % 2 ? std::cos(angle) : std::sin(angle)) - 2 / h * (rate[i] - v[i]));
      at(A, i, i) += m * (4 / (h * h) - w * w);
      at(A, i, other) -= m * turn * (4 * w / h + w_dot);
    }
    solve(A, F);
    for (int i = 0; i < n; ++i) {
      middle[i] += F[i];
      rate[i] += 2 / h * F[i];
    }
    if (size(F) < 1e-12 * size(middle)) break;
  }
  for (int i = 0; i < n; ++i) {
    x[i] += h * rate[i];
    v[i] = 2 * rate[i] - v[i];
  }
}

// The first natural frequency about the steady state: below it the matrix has no negative pivot.
double first_frequency(const Chain& chain, double w) {
  const int n = 2 * chain.n;
  Vector x = chain.straight(), nothing(n, 0.0);
  Band K;
  for (int iteration = 0; iteration < 5; ++iteration) {
    K.assign(n, std::array<double, 2 * WIDTH + 1>{});
    Vector F(n, 0.0);
    chain.springs(x, nothing, 0.0, F, K);
    for (int i = 0; i < n; ++i) {
      F[i] += chain.mass[i / 2] * w * w * x[i];
      at(K, i, i) -= chain.mass[i / 2] * w * w;
    }
    solve(K, F);
    for (int i = 0; i < n; ++i) x[i] += F[i];
  }
  double low = 0.0, high = 10 * std::sqrt(chain.EI / chain.mass[0] * chain.l) / std::pow(chain.l * chain.n, 2) + 10 * w;
  while (high - low > 1e-13 * high) {
    const double nu = (low + high) / 2;
    Band A = K;
    for (int i = 0; i < n; ++i) {
      at(A, i, i) -= chain.mass[i / 2] * nu * nu;
      at(A, i, i % 2 ? i - 1 : i + 1) -= 2 * w * nu * chain.mass[i / 2];
    }
    Vector zero(n, 0.0);
    (solve(A, zero) ? high : low) = nu;
  }
  return (low + high) / 2;
}

// Opens a table to add rows to, with its header if it is new.
std::ofstream rows_of(const std::string& file, const std::string& header) {
  const bool is_new = !std::filesystem::exists(file);
  std::ofstream stream(file, std::ios::app);
  if (is_new) stream << header << "\n";
  stream.precision(17);
  return stream;
}

void frequencies(const Case& c, int elements) {
  std::ofstream out = rows_of(c.cells.at("id") + ".csv", "elements,speed,frequency");
  std::istringstream speeds(c.cells.at("speeds"));
  for (double speed; speeds >> speed;)
    out << elements << "," << speed << "," << first_frequency(Chain(c, elements), speed) << "\n";
}

void start_on_orbit(const std::string& file, Vector& x, Vector& v) {
  const Table start = table(file);
  const std::string names[2] = {"X", "Y"};
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] = std::stod(start.rows[k / 2 + 1][start.column.at(names[k % 2])]);
    v[k] = std::stod(start.rows[k / 2 + 1][start.column.at(names[k % 2] + "_dot")]);
  }
}

void history(const Case& c, const std::string& kit, int elements, const std::string& step) {
  const auto started = std::chrono::steady_clock::now();
  const double h = std::stod(step);
  if (!(h > 0.0 && h <= 0.02)) throw std::runtime_error("the step must be above 0 and at most 0.02 s");
  const Chain chain(c, elements);
  const Drive drive{c["omega"], c["T"]};
  Vector x = chain.straight(), v(x.size(), 0.0);
  const std::string id = c.cells.at("id");
  if (c.has("amplitudes")) start_on_orbit(kit + "/start_" + id + "_" + std::to_string(elements) + ".csv", x, v);
  char name[100];
  std::snprintf(name, sizeof name, "%s/m%03d_h%s.csv", id.c_str(), elements, step.c_str());
  std::filesystem::create_directory(id);
  std::ofstream out(name);
  out.precision(12);
  out << "time,q,q_dot\n";
  const int steps = static_cast<int>(std::ceil(c["duration"] / h - 1e-9));
  const int every = std::max(1, static_cast<int>(0.01 / h + 1e-9));
  for (int k = 0;; ++k) {
    if (k % every == 0 || k == steps) out << k * h << "," << x.back() << "," << v.back() << "\n";
    if (k == steps) break;
    advance(chain, drive, k * h, h, x, v);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
  rows_of("runs.csv", "file,elements,dof,step,wall_s")
      << name << "," << elements << "," << x.size() << "," << h << "," << wall.count() << "\n";
}

int main(int count, char** words) try {
  if (count < 4) throw std::runtime_error("usage: starter case elements step [folder of the kit]");
  const std::string kit = count > 4 ? words[4] : "..", id = words[1];
  const int elements = std::stoi(words[2]);
  if (elements < 2) throw std::runtime_error("elements must be at least 2");
  const Case c = read_case(kit, id);
  if (c.cells.at("level") == "space") throw std::runtime_error("this starter stays in the plane");
  if (c.cells.at("asked") == "frequencies")
    frequencies(c, elements);
  else if (!c.has("duration"))
    throw std::runtime_error("this starter gives no backbones");
  else
    history(c, kit, elements, words[3]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
