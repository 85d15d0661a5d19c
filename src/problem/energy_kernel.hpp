#pragma once

#include <array>

#include "vesica/core/small_tensor.hpp"
#include "vesica/model/model.hpp"
#include "vesica/model/two_phase.hpp"
#include "vesica/problem/energy_problem.hpp"

namespace vesica::problem {

/// Fields of the dual mixed energy at a quadrature point, with their derivatives along (u, v); also
/// the derivative of an integrand with respect to them.
template <class T>
struct EnergyPoint {
  Vec3<T> x, x_u, x_v;  ///< position [length]
  Vec3<T> p, p_u, p_v;  ///< bending moment -k_kappa (kappa - kappa_s) nu [energy/length]
  T c{}, c_u{}, c_v{};  ///< order parameter
};

/// Integrands of bending and line energy, times the area element.
struct EnergyDensities {
  double bending = 0;
  double line = 0;
};

/// With n = x_u x x_v, N = |n| and w = c_u x_v - c_v x_u:
///
///   N grad x : grad p = nu . (p_u x x_v + x_u x p_v),    N |grad c|^2 = |w|^2 / N.
inline EnergyDensities energy_densities(const model::Physics& physics,
                                        const EnergyPoint<double>& in) {
  const auto& m = physics.material;
  const auto n = cross(in.x_u, in.x_v);
  const double area = norm(n);
  EnergyDensities result;
  result.bending = (1 / area) * dot(n, cross(in.p_u, in.x_v) + cross(in.x_u, in.p_v)) +
                   model::interpolate(m.spontaneous_curvature, in.c) * dot(n, in.p) -
                   0.5 * area * dot(in.p, in.p) / model::interpolate(m.bending_rigidity, in.c);
  if (!physics.is_two_phase) return result;
  const auto w = in.c_u * in.x_v - in.c_v * in.x_u;
  result.line = m.line_tension * (0.5 * m.interface_width * dot(w, w) / area +
                                  area * model::double_well(in.c) / m.interface_width);
  return result;
}

/// Derivative of the integrand of E_h without the Gaussian term,
///
///   N [grad x : grad p + kappa_s nu . p - |p|^2 / (2 k) + sigma (eps/2 |grad c|^2 + psi / eps)]
///
/// (N the area element), plus lambda_V x . n / 3 + lambda_A N + lambda_c N h(c).
template <class T>
EnergyPoint<T> energy_point_gradient(const model::Physics& physics, const Multipliers& multipliers,
                                     const EnergyPoint<T>& in) {
  const auto& m = physics.material;
  const Vec3<T> n = cross(in.x_u, in.x_v);
  const T area = norm(n);
  const T inverse = 1.0 / area;
  const Vec3<T> nu = inverse * n;
  const T k = model::interpolate(m.bending_rigidity, in.c);
  const T curvature = model::interpolate(m.spontaneous_curvature, in.c);
  const T p_squared = dot(in.p, in.p);
  const Vec3<T> moment = cross(in.p_u, in.x_v) + cross(in.x_u, in.p_v);

  // q: derivative with respect to n
  T along_normal = -0.5 * p_squared / k + multipliers[1];
  EnergyPoint<T> out;
  if (physics.is_two_phase) {
    const double sigma = m.line_tension;
    const double eps = m.interface_width;
    const Vec3<T> w = in.c_u * in.x_v - in.c_v * in.x_u;
    const Vec3<T> w_scaled = (sigma * eps * inverse) * w;
    along_normal = along_normal + (sigma / eps) * model::double_well(in.c) +
                   multipliers[2] * model::phase_indicator(in.c) -
                   (0.5 * inverse) * dot(w_scaled, w);
    out.x_u = -(in.c_v * w_scaled);
    out.x_v = in.c_u * w_scaled;
    out.c_u = dot(w_scaled, in.x_v);
    out.c_v = -dot(w_scaled, in.x_u);
    out.c = model::interpolate_derivative(m.spontaneous_curvature, in.c) * dot(n, in.p) +
            area * (0.5 * p_squared / (k * k) *
                        model::interpolate_derivative(m.bending_rigidity, in.c) +
                    (sigma / eps) * model::double_well_derivative(in.c) +
                    multipliers[2] * model::phase_indicator_derivative(in.c));
  }
  const Vec3<T> q = inverse * (moment - dot(nu, moment) * nu) + curvature * in.p +
                    along_normal * nu + (multipliers[0] / 3) * in.x;
  out.x = (multipliers[0] / 3) * n;
  out.x_u = out.x_u + cross(in.x_v, q) + cross(in.p_v, nu);
  out.x_v = out.x_v + cross(q, in.x_u) + cross(nu, in.p_u);
  out.p = curvature * n - (area / k) * in.p;
  out.p_u = cross(in.x_v, nu);
  out.p_v = cross(nu, in.x_u);
  return out;
}

/// Adds the terms of the gradient flow, int (x' . nu) nu . xi and eps omega int c' phi.
template <class T>
void add_flow_terms(const model::Physics& physics, const Vec3<T>& velocity, double c_rate,
                    const EnergyPoint<T>& in, EnergyPoint<T>& out) {
  const Vec3<T> n = cross(in.x_u, in.x_v);
  const T area = norm(n);
  out.x = out.x + (dot(velocity, n) / area) * n;
  const auto& m = physics.material;
  if (physics.is_two_phase)
    out.c = out.c + (m.interface_width * m.kinetic_coefficient * c_rate) * area;
}

}  // namespace vesica::problem
