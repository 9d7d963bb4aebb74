#include "node/shape/dual_quaternion.h"

#include <algorithm>
#include <cmath>

namespace mars::shape {
namespace {

struct Axes {
  double m[3][3];
};

constexpr Axes kNone{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr double kLeastVolume = 1e-3;  // of axes of length 1
// Less, so that what is not flat in the world has a turn in eye space too, where the axes are rounded.
constexpr double kLeastTurned = kLeastVolume / 2;
constexpr int kMostSteps = 40;
constexpr double kNear = 1e-14;

// The bone's axes at length 1; 0 stays 0.
Axes unit_axes(const wire::Matrix& bone) {
  Axes axes{};
  for (std::size_t c = 0; c < 3; ++c) {
    double most = 0, square = 0;  // squares of what is small would vanish
    for (std::size_t r = 0; r < 3; ++r) most = std::max(most, std::abs(bone.m[r][c]));
    if (!(most > 0)) continue;
    for (std::size_t r = 0; r < 3; ++r) axes.m[r][c] = bone.m[r][c] / most;
    for (std::size_t r = 0; r < 3; ++r) square += axes.m[r][c] * axes.m[r][c];
    for (std::size_t r = 0; r < 3; ++r) axes.m[r][c] /= std::sqrt(square);
  }
  return axes;
}

double cofactor(const Axes& axes, int r, int c) {
  const double *const one = axes.m[(r + 1) % 3], *const other = axes.m[(r + 2) % 3];
  const int next = (c + 1) % 3, last = (c + 2) % 3;
  return one[next] * other[last] - one[last] * other[next];
}

double volume(const Axes& axes) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += axes.m[0][c] * cofactor(axes, 0, c);
  return sum;
}

// The mean of the axes and their inverse's transpose. Returns how far that is from the axes.
double step(Axes& axes) {
  const double all = volume(axes);
  Axes next;
  double way = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      next.m[r][c] = (axes.m[r][c] + cofactor(axes, r, c) / all) / 2;
      way = std::max(way, std::abs(next.m[r][c] - axes.m[r][c]));
    }
  axes = next;
  return way;
}

// Higham, "Computing the polar decomposition - with applications", 1986.
Axes nearest_turn(const wire::Matrix& bone) {
  Axes axes = unit_axes(bone);
  const double all = volume(axes);
  if (!(std::abs(all) >= kLeastTurned)) return kNone;
  if (all < 0)
    for (auto& row : axes.m)
      for (double& number : row) number = -number;
  for (int i = 0; i < kMostSteps && step(axes) > kNear; ++i) continue;
  return axes;
}

// From the largest of its numbers the others follow with the least rounding (Shepperd, "Quaternion from rotation
// matrix", 1978); it is above 0.
void put_quaternion(const double (&turn)[3][3], double (&out)[4]) {
  const double trace = turn[0][0] + turn[1][1] + turn[2][2];
  int largest = 0;  // w, x, y, z
  double most = trace;
  for (int axis = 0; axis < 3; ++axis)
    if (turn[axis][axis] > most) largest = axis + 1, most = turn[axis][axis];
  if (largest == 0) {
    out[0] = 1 + trace;
    for (int i = 0; i < 3; ++i) out[i + 1] = turn[(i + 2) % 3][(i + 1) % 3] - turn[(i + 1) % 3][(i + 2) % 3];
  } else {
    const int i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
    out[0] = turn[k][j] - turn[j][k];
    out[i + 1] = 1 + most - turn[j][j] - turn[k][k];
    out[j + 1] = turn[j][i] + turn[i][j];
    out[k + 1] = turn[k][i] + turn[i][k];
  }
  const double length = std::sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2] + out[3] * out[3]);
  for (double& number : out) number /= length;
}

}  // namespace

bool is_flat(const wire::Matrix& bone) { return !(std::abs(volume(unit_axes(bone))) >= kLeastVolume); }

BoneParts parts_of(const wire::Matrix& bone) {
  const Axes turn = nearest_turn(bone);
  BoneParts parts{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      parts.turn[r][c] = turn.m[r][c];
      for (std::size_t i = 0; i < 3; ++i) parts.stretch[r][c] += turn.m[i][r] * bone.m[i][c];
    }
    parts.place[r] = bone.m[r][3];
  }
  return parts;
}

DualBone<double> dual_bone(const BoneParts& parts) {
  DualBone<double> bone;
  put_quaternion(parts.turn, bone.real);
  const auto& [w, x, y, z] = bone.real;
  const auto& [px, py, pz] = parts.place;
  bone.dual[0] = -0.5 * (px * x + py * y + pz * z);
  bone.dual[1] = 0.5 * (w * px + (py * z - pz * y));
  bone.dual[2] = 0.5 * (w * py + (pz * x - px * z));
  bone.dual[3] = 0.5 * (w * pz + (px * y - py * x));
  std::copy_n(&parts.stretch[0][0], 9, &bone.stretch[0][0]);
  return bone;
}

DualBone<float> rounded(const DualBone<double>& bone) {
  const auto round = [](double number) { return static_cast<float>(number); };
  DualBone<float> out;
  std::transform(bone.real, bone.real + 4, out.real, round);
  std::transform(bone.dual, bone.dual + 4, out.dual, round);
  for (int r = 0; r < 3; ++r) std::transform(bone.stretch[r], bone.stretch[r] + 3, out.stretch[r], round);
  return out;
}

}  // namespace mars::shape
