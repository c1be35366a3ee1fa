#pragma once

#include <cmath>

namespace sigmascape {

/// Plain Cartesian vectors: x east, y north, z up. Float for geometry near a local origin, double for ranges and
/// phases.

template <typename T>
struct Vec2 {
  T x{}, y{};
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(Vec2 a, T s) { return {a.x * s, a.y * s}; }
};

template <typename T>
struct Vec3 {
  T x{}, y{}, z{};

  template <typename U>
  [[nodiscard]] constexpr Vec3<U> to() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, Vec3 a) { return a * s; }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
};

template <typename T>
[[nodiscard]] constexpr T dot(Vec2<T> a, Vec2<T> b) {
  return a.x * b.x + a.y * b.y;
}
/// The z component of the cross product: positive when b lies counter-clockwise of a.
template <typename T>
[[nodiscard]] constexpr T cross(Vec2<T> a, Vec2<T> b) {
  return a.x * b.y - a.y * b.x;
}
template <typename T>
[[nodiscard]] T length(Vec2<T> a) {
  return std::hypot(a.x, a.y);
}

template <typename T>
[[nodiscard]] constexpr T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
[[nodiscard]] constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T>
[[nodiscard]] T length(Vec3<T> a) {
  return std::sqrt(dot(a, a));
}
template <typename T>
[[nodiscard]] Vec3<T> normalized(Vec3<T> a) {
  return a * (T{1} / length(a));
}

/// The direction of a vector on the level, clockwise from north, from −π to π.
template <typename T>
[[nodiscard]] T azimuth_of(Vec2<T> way) {
  return std::atan2(way.x, way.y);
}
template <typename T>
[[nodiscard]] T azimuth_of(Vec3<T> way) {
  return std::atan2(way.x, way.y);
}

using Vec2d = Vec2<double>;
using Vec2f = Vec2<float>;
using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

/// Two unit vectors that complete `normal` to a right-handed basis (Duff et al., "Building an Orthonormal Basis,
/// Revisited", 2017).
struct Basis {
  Vec3f tangent, bitangent, normal;

  explicit Basis(Vec3f unit_normal) : normal(unit_normal) {
    const float sign = std::copysign(1.0F, normal.z);
    const float a = -1.0F / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    tangent = {1.0F + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    bitangent = {b, sign + normal.y * normal.y * a, -normal.y};
  }
  [[nodiscard]] Vec3f local_from_world(Vec3f w) const { return {dot(w, tangent), dot(w, bitangent), dot(w, normal)}; }
  [[nodiscard]] Vec3f world_from_local(Vec3f v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
};

}  // namespace sigmascape
