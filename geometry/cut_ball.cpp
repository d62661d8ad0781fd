#include "geometry/cut_ball.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace acinus::geometry {
namespace {

using Vec2 = Eigen::Vector2d;

/// Intersection of another plane with the plane of a face: x . normal <= distance is kept.
struct CutLine {
  Vec2 normal;
  double distance;
};

/// Sums over pieces of one face, about the projection of the ball's centre on it.
struct FaceSum {
  double area = 0;
  Vec2 moment = Vec2::Zero();  ///< area times centroid
  double angle = 0;            ///< solid angle, seen from the centre of the ball
};

/// Collects the lines that cross the disc. @return false: nothing is left of the face
bool find_lines(std::span<const BallCut> planes, std::size_t face, const Vec3& along_u,
                const Vec3& along_v, double disc, std::vector<CutLine>& lines) {
  constexpr double kParallel = 1e-12;
  lines.clear();
  const BallCut& f = planes[face];
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (k == face) continue;
    const Vec2 in_plane(planes[k].normal.dot(along_u), planes[k].normal.dot(along_v));
    const double length = in_plane.norm(),
                 distance = planes[k].distance - f.distance * f.normal.dot(planes[k].normal);
    if (length < kParallel) {
      // Of two equal planes the first one has the face.
      if (distance < 0 || (distance == 0 && k < face && f.normal.dot(planes[k].normal) > 0))
        return false;
      continue;
    }
    if (distance <= -disc * length) return false;
    if (distance < disc * length) lines.push_back({in_plane / length, distance / length});
  }
  return true;
}

/// Solid angle of a right triangle: integral of 1 - h/|x| over the angle from the foot of a line at
/// distance c to the point t along it.
double triangle_angle(double t, double c, double h) {
  const double angle = std::atan2(t, c);
  return angle - std::asin(std::clamp(std::sin(angle) * h / std::hypot(h, c), -1.0, 1.0));
}

/// Adds the triangle between the foot and the segment of a line that bounds the face.
void add_straight(const std::vector<CutLine>& lines, std::size_t own, double disc, double height,
                  FaceSum& sum) {
  const CutLine& line = lines[own];
  const Vec2 along(-line.normal.y(), line.normal.x());
  double high = std::sqrt(disc * disc - line.distance * line.distance), low = -high;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (k == own) continue;
    const double slope = lines[k].normal.dot(along),
                 room = lines[k].distance - line.distance * lines[k].normal.dot(line.normal);
    if (slope > 0) high = std::min(high, room / slope);
    if (slope < 0) low = std::max(low, room / slope);
    if (slope == 0 && (room < 0 || (room == 0 && k < own && lines[k].normal.dot(line.normal) > 0)))
      return;
  }
  if (!(low < high)) return;
  const double area = 0.5 * line.distance * (high - low);
  sum.area += area;
  sum.moment += area * (2 * line.distance * line.normal + (low + high) * along) / 3;
  const double c = std::abs(line.distance);
  if (c > 0)
    sum.angle += std::copysign(triangle_angle(high, c, height) - triangle_angle(low, c, height),
                               line.distance);
}

/// Adds the sectors between the foot and the arcs of the disc's rim that no line cuts off.
void add_round(const std::vector<CutLine>& lines, double disc, double height, double radius,
               FaceSum& sum) {
  std::vector<std::pair<double, double>> cut;  // angles
  for (const CutLine& line : lines) {
    const double half = std::acos(line.distance / disc);
    double low = std::atan2(line.normal.y(), line.normal.x()) - half;
    if (low < 0) low += 2 * kPi;
    if (low >= 2 * kPi) low -= 2 * kPi;
    const double high = low + 2 * half;
    cut.emplace_back(low, std::min(high, 2 * kPi));
    if (high > 2 * kPi) cut.emplace_back(0, high - 2 * kPi);
  }
  cut.emplace_back(2 * kPi, 2 * kPi);
  std::ranges::sort(cut);
  double from = 0;
  for (const auto& [low, high] : cut) {
    if (low > from) {
      sum.area += 0.5 * disc * disc * (low - from);
      sum.moment += disc * disc * disc / 3 *
                    Vec2(std::sin(low) - std::sin(from), std::cos(from) - std::cos(low));
      sum.angle += (low - from) * (1 - height / radius);
    }
    from = std::max(from, high);
  }
}

}  // namespace

CutBall cut_ball(double radius, std::span<const BallCut> planes) {
  CutBall out{0, std::vector<CutFace>(planes.size())};
  double angle = 0, cones = 0;
  bool middle_left = true;
  std::vector<CutLine> lines;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const BallCut& plane = planes[f];
    if (plane.distance <= -radius) return {0, std::vector<CutFace>(planes.size())};
    middle_left = middle_left && plane.distance > 0;
    if (plane.distance >= radius) continue;
    const double height = std::abs(plane.distance),
                 disc = std::sqrt(radius * radius - height * height);
    const Vec3 u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    if (!find_lines(planes, f, u, v, disc, lines)) continue;
    FaceSum sum;
    for (std::size_t k = 0; k < lines.size(); ++k) add_straight(lines, k, disc, height, sum);
    add_round(lines, disc, height, radius, sum);
    if (!(sum.area > 0)) continue;
    const Vec2 middle = sum.moment / sum.area;
    out.face[f] = {sum.area, plane.distance * plane.normal + middle.x() * u + middle.y() * v};
    cones += plane.distance * sum.area;
    angle += plane.distance > 0 ? sum.angle : -sum.angle;
  }
  const double sphere = (middle_left ? 4 * kPi : 0) - angle;
  out.volume = std::max(0.0, (cones + radius * radius * radius * sphere) / 3);
  return out;
}

}  // namespace acinus::geometry
