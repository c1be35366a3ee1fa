#pragma once

#include <array>
#include <functional>

#include "sigmascape/scatter/diffuse.h"

namespace sigmascape::scatter {

/// Area reflectivity in backscatter by polarization, linear.
struct Sigma0 {
  double vv = 0.0;
  double hh = 0.0;
  double hv = 0.0;

  friend constexpr bool operator==(const Sigma0&, const Sigma0&) = default;
};

/// A surface of which only σ0(θ) in backscatter is known, with the reciprocal extension to all pairs of directions that
/// gives back σ0 exactly where both are the same:
///
///     b_pq(i, o) = √(γ_pq(θi) γ_pq(θo)) / (2π (cos θi + cos θo)),   γ_pq(θ) = σ0_pq(θ) / cos θ
///
/// docs/physics/diffuse.md, Eq. (4). For constant γ it is Lommel–Seeliger's law.
class ReciprocalBackscatter {
 public:
  /// σ0 over cos θ in (0, 1]. It is evaluated once, at some thousand angles.
  using Law = std::function<Sigma0(double cos_incidence)>;

  ReciprocalBackscatter(const Law& law, const Depolarization& depolarization);

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, Vec3f normal) const;
  [[nodiscard]] DirectionSample sample(Vec3f to_source, Vec3f normal, Vec2f u) const;
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                  PhaseDraw draw) const;

  /// The part of arriving power that leaves again, for the transmit polarization that loses less.
  /// docs/physics/diffuse.md, Eq. (5).
  [[nodiscard]] double albedo(double cos_incidence) const;
  /// The greatest up to 89° of incidence, of all angles at which the law was evaluated, for a law may go in steps.
  /// Towards grazing any σ0 that does not vanish would return more than arrives in the end.
  [[nodiscard]] double greatest_albedo() const;

 private:
  /// γ^¼ by polarization: two of them make the root of √(γi γo).
  using Quartic = DiffuseAmplitudes;
  static constexpr int intervals = 512;

  [[nodiscard]] Quartic quartic(float cos_angle) const;

  std::array<Quartic, intervals + 1> high_{};  // from the zenith to 60° of incidence, even steps of √(1 − cos θ)
  std::array<Quartic, intervals + 1> low_{};   // from grazing to 60° of incidence, even steps of √cos θ
  DiffusePolarization polarization_;
};

}  // namespace sigmascape::scatter
