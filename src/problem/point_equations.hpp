#pragma once

#include <array>

#include "vesica/fem/surface_element.hpp"
#include "vesica/model/model.hpp"

namespace vesica::problem {

/// Fields and derivatives along the reference coordinates (u, v) at a quadrature point.
template <class T>
struct PointInputs {
  Vec3<T> x;  ///< not differentiated: the Jacobian leaves out what depends on the place itself
  Vec3<T> x_u, x_v;
  Vec3<T> x_uu, x_uv, x_vv;
  T kappa{}, kappa_u{}, kappa_v{};
  T c{1.0}, c_u{}, c_v{};
  Vec3<T> velocity;
  double c_rate = 0;  ///< c' along the moving nodes
};

/// Parameters of the equations at a point, which are not differentiated.
struct PointSettings {
  const model::Physics& physics;
  double damping = 0;
  std::array<double, model::num_constraints> multipliers{};
};

/// Integrands that multiply the test function (value, d/du, d/dv) in the five equations of a node:
/// rows 0 to 2 the curvature equation (b), row 3 the velocity equation (a), row 4 the phase
/// equation (d).
template <class T>
using PointOutputs = std::array<std::array<T, 3>, 5>;

inline constexpr std::size_t velocity_row = 3;
inline constexpr std::size_t phase_row = 4;

/// Returns eps omega, the weight of c' in (d) [length^2].
inline double phase_mobility(const model::Physics& physics) {
  return physics.material.interface_width * physics.material.kinetic_coefficient;
}

template <class T>
model::SurfacePoint<T> surface_point(const PointInputs<T>& in, const fem::TangentFrame<T>& frame,
                                     const Sym3<T>& shape_operator) {
  model::SurfacePoint<T> point;
  point.position = in.x;
  point.normal = frame.normal;
  point.mean_curvature = in.kappa;
  point.mean_curvature_gradient = fem::surface_gradient(frame, in.kappa_u, in.kappa_v);
  point.shape_operator = shape_operator;
  point.order_parameter = in.c;
  point.order_parameter_gradient = fem::surface_gradient(frame, in.c_u, in.c_v);
  return point;
}

/// Adds `factor` times the variation of a term: at once where the term has one of its own, else to
/// the density, whose variation is taken once for all.
template <class Term, class T>
void add_variation(const model::Physics& physics, const model::SurfacePoint<T>& point,
                   double factor, model::Variation<T>& sum, model::LocalDensity<T>& local) {
  if (factor == 0 || !model::takes_part<Term>(physics)) return;
  if constexpr (model::HasVariation<Term>) {
    sum.add(factor, Term::variation(physics.material, point));
  } else {
    const model::LocalPoint<T>& without_curvature = point;
    Term::add_to(physics.material, without_curvature, factor, local);
  }
}

/// Returns the variation of the energy plus multipliers times constraints: dF + sum lambda_i dC_i.
template <class T>
model::Variation<T> lagrangian_variation(const PointSettings& settings,
                                         const model::SurfacePoint<T>& point) {
  model::Variation<T> sum;
  model::LocalDensity<T> local;
  model::for_each_term<model::Energies>([&]<class Energy>(std::size_t) {
    add_variation<Energy>(settings.physics, point, 1, sum, local);
  });
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    add_variation<Constraint>(settings.physics, point, settings.multipliers[place], sum, local);
  });
  sum.add(1.0, variation_of(local, point));
  return sum;
}

/// Puts a variation into the rows of (a) and (d), times the area element.
template <class T>
void put_variation(const model::Variation<T>& v, const fem::TangentFrame<T>& frame,
                   PointOutputs<T>& out) {
  const Vec3<T> b = frame.area_element * v.b;
  const Vec3<T> q = frame.area_element * v.q;
  out[velocity_row] = {frame.area_element * v.a, dot(b, frame.dual_u), dot(b, frame.dual_v)};
  out[phase_row] = {frame.area_element * v.s, dot(q, frame.dual_u), dot(q, frame.dual_v)};
}

/// Computes the equations (a), (b) and (d) at a point, in the order of PointOutputs, all terms on
/// one side:
///   (b)  int grad xi : grad x + kappa nu . xi + alpha xi . (I - nu nu^T) x'
///   (a)  int (x' . nu) chi + <dF + sum lambda_i dC_i, chi>
///   (d)  eps omega int c' phi + <dF + sum lambda_i dC_i, phi>
template <class T>
PointOutputs<T> point_equations(const PointSettings& settings, const PointInputs<T>& in,
                                const fem::TangentFrame<T>& frame, const Sym3<T>& shape_operator) {
  const auto point = surface_point(in, frame, shape_operator);
  PointOutputs<T> out;
  put_variation(lagrangian_variation(settings, point), frame, out);
  const T normal_velocity = dot(in.velocity, frame.normal);
  out[velocity_row][0] = out[velocity_row][0] + frame.area_element * normal_velocity;
  out[phase_row][0] =
      out[phase_row][0] + (phase_mobility(settings.physics) * in.c_rate) * frame.area_element;
  const Vec3<T> curvature_vector = (in.kappa - settings.damping * normal_velocity) * frame.normal;
  const Vec3<T> value = frame.area_element * (curvature_vector + settings.damping * in.velocity);
  const Vec3<T> along_u = frame.area_element * frame.dual_u;
  const Vec3<T> along_v = frame.area_element * frame.dual_v;
  out[0] = {value.x, along_u.x, along_v.x};
  out[1] = {value.y, along_u.y, along_v.y};
  out[2] = {value.z, along_u.z, along_v.z};
  return out;
}

}  // namespace vesica::problem
