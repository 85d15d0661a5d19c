#pragma once

#include <array>

#include "local_form.hpp"
#include "vesica/core/small_tensor.hpp"
#include "vesica/model/model.hpp"
#include "vesica/model/two_phase.hpp"
#include "vesica/problem/energy_problem.hpp"

namespace vesica::problem {

/// Fields of the dual mixed energy at a quadrature point, with their derivatives along (u, v); also
/// the derivative of an integrand with respect to them.
template <class T>
struct EnergyPoint : PointFields<T> {
  Vec3<T> p, p_u, p_v;  ///< bending moment -k_kappa (kappa - kappa_s) nu [energy/length]
};

/// True for the energies that have a form of their own in E_h, in this file, instead of a density
/// without curvature or a distributional curvature.
template <class Energy>
inline constexpr bool has_own_discrete_form = false;
template <>
inline constexpr bool has_own_discrete_form<model::BendingEnergy> = true;

/// Computes the integrand of the bending energy times N. With n = x_u x x_v, N = |n|:
///
///   N grad x : grad p = nu . (p_u x x_v + x_u x p_v).
inline double bending_density(const model::Physics& physics, const EnergyPoint<double>& in) {
  const auto& m = physics.material;
  const auto n = cross(in.x_u, in.x_v);
  const double area = norm(n);
  return (1 / area) * dot(n, cross(in.p_u, in.x_v) + cross(in.x_u, in.p_v)) +
         model::interpolate(m.spontaneous_curvature, in.c) * dot(n, in.p) -
         0.5 * area * dot(in.p, in.p) / model::interpolate(m.bending_rigidity, in.c);
}

/// Adds the integrands, times the area element and `weight`, of all energies but the Gaussian one.
inline void add_densities(const model::Physics& physics, const EnergyPoint<double>& in,
                          double weight, std::array<double, model::num_energies>& sum) {
  const auto frame = fem::tangent_frame(in.x_u, in.x_v);
  const auto point = local_point(in, frame);
  sum[model::place_of<model::Energies, model::BendingEnergy>] +=
      weight * bending_density(physics, in);
  model::for_each_term<model::Energies>([&]<class Energy>(std::size_t place) {
    if constexpr (model::LocalTerm<Energy>) {
      model::LocalDensity<double> f;
      if (model::takes_part<Energy>(physics)) Energy::add_to(physics.material, point, 1.0, f);
      sum[place] += weight * frame.area_element * f.value;
    } else {
      static_assert(model::CurvatureTerm<Energy> || has_own_discrete_form<Energy>,
                    "an energy needs add_to(), a distributional curvature with its weight, or a "
                    "form of its own in the discrete energy");
    }
  });
}

/// Sets the derivative of the integrand of E_h with respect to p and its derivatives.
template <class T>
void put_moment_derivative(const model::Physics& physics, const EnergyPoint<T>& in,
                           const fem::TangentFrame<T>& frame, EnergyPoint<T>& out) {
  const auto& m = physics.material;
  const T k = model::interpolate(m.bending_rigidity, in.c);
  const T curvature = model::interpolate(m.spontaneous_curvature, in.c);
  out.p = frame.area_element * (curvature * frame.normal - (1.0 / k) * in.p);
  out.p_u = cross(in.x_v, frame.normal);
  out.p_v = cross(frame.normal, in.x_u);
}

/// Computes the derivative of the integrand of E_h + sum lambda_i C_i without the Gaussian term,
///
///   N [grad x : grad p + kappa_s nu . p - |p|^2 / (2 k) + local energies + sum lambda_i f_i],
///
/// N the area element.
template <class T>
EnergyPoint<T> energy_point_gradient(const model::Physics& physics, const Multipliers& multipliers,
                                     const EnergyPoint<T>& in) {
  const auto& m = physics.material;
  const auto frame = fem::tangent_frame(in.x_u, in.x_v);
  const Vec3<T>& nu = frame.normal;
  const T& area = frame.area_element;
  const auto point = local_point(in, frame);
  model::LocalDensity<T> local;
  add_local_terms<model::Energies>(
      physics, point, [](std::size_t) { return 1.0; }, local);
  add_local_terms<model::Constraints>(
      physics, point, [&](std::size_t place) { return multipliers[place]; }, local);

  const T k = model::interpolate(m.bending_rigidity, in.c);
  const T curvature = model::interpolate(m.spontaneous_curvature, in.c);
  const T p_squared = dot(in.p, in.p);
  const Vec3<T> moment = cross(in.p_u, in.x_v) + cross(in.x_u, in.p_v);
  local.value = local.value - 0.5 * p_squared / k;
  if (physics.is_two_phase) {
    local.by_order_parameter +=
        model::interpolate_derivative(m.spontaneous_curvature, in.c) * dot(nu, in.p) +
        0.5 * p_squared / (k * k) * model::interpolate_derivative(m.bending_rigidity, in.c);
  }
  const Vec3<T> bending_by_n = (1.0 / area) * (moment - dot(nu, moment) * nu) + curvature * in.p;
  EnergyPoint<T> out;
  static_cast<PointFields<T>&>(out) =
      derivative_of<T>(local, point, in, frame, physics.is_two_phase, bending_by_n);
  out.x_u = out.x_u + cross(in.p_v, nu);
  out.x_v = out.x_v + cross(nu, in.p_u);
  put_moment_derivative(physics, in, frame, out);
  return out;
}

/// Adds the terms of the gradient flow, int (x' . nu) nu . xi and eps omega int c' phi.
template <class T, class Rate>
void add_flow_terms(const model::Physics& physics, const Vec3<T>& velocity, const Rate& c_rate,
                    const EnergyPoint<T>& in, EnergyPoint<T>& out) {
  const Vec3<T> n = cross(in.x_u, in.x_v);
  const T area = norm(n);
  out.x = out.x + (dot(velocity, n) / area) * n;
  const auto& m = physics.material;
  if (physics.is_two_phase)
    out.c = out.c + (m.interface_width * m.kinetic_coefficient * c_rate) * area;
}

}  // namespace vesica::problem
