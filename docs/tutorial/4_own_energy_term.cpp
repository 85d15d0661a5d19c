// 4. An energy term of your own
// =============================
//
// Introduction
// ------------
// All terms of the energy are integrals over the surface of a density that looks at one point. This
// program writes a new one, the weight of a membrane of unequal density in a field of gravity,
//
//     F = int w(c) z,   w = w_1 where c = 1 and w_2 where c = -1,
//
// tries it before it goes into the library, and measures it on a sphere of two halves.
//
// The commented program
// ---------------------
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vesica/fem/surface_integral.hpp>
#include <vesica/model/surface_functional.hpp>
#include <vesica/model/two_phase.hpp>
#include <vesica/shapes/shapes.hpp>

namespace {

using namespace vesica;

// A term adds `factor` times its density f and the partial derivatives of f to a sum. This one
// depends on the order parameter c and on the position x. The weights would become an option of
// model::Material; here they are constants.
struct Weight {
  static constexpr model::PhasePair weight{2.0, 1.0};

  template <class T>
  static void add_to(const model::Material&, const model::LocalPoint<T>& point, double factor,
                     model::LocalDensity<T>& sum) {
    const T& c = point.order_parameter;
    const T w = factor * model::interpolate(weight, c);
    const T slope = factor * model::interpolate_derivative(weight, c);
    sum.value += w * point.position.z;
    sum.by_order_parameter += slope * point.position.z;
    sum.by_position = sum.by_position + w * Vec3<T>{T(0.0), T(0.0), T(1.0)};
  }
};

// The compiler tells whether the library could take it: what looks at the curvature could not.
static_assert(model::LocalTerm<Weight>);

// The energy of a surface: a loop over the quadrature points. c changes from -1 to 1 with z.
double energy(const mesh::Surface& surface, double shift) {
  double sum = 0;
  fem::for_each_point(*surface.triangulation, surface.positions, [&](const auto& sample) {
    model::SurfacePoint<double> point{};
    point.position = fem::vector_at(surface.positions, sample);
    point.normal = sample.frame.normal;
    point.order_parameter = point.position.z;
    point.position.z += shift;
    sum += sample.weight * model::density_of<Weight>({}, point);
  });
  return sum;
}

}  // namespace

int main() {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::sphere;
  options.resolution = 6;
  const mesh::Surface sphere = shapes::make_shape(options);

  // On the unit sphere with c = z, w = 3/2 + h(c)/2 and h(c) = c (3 - c^2) / 2, so that
  // F = 1/2 int h(z) z = pi int_-1^1 z^2 (3 - z^2) / 2 dz = pi (1 - 1/5).
  const double exact = 0.8 * std::numbers::pi;
  const double measured = energy(sphere, 0);
  std::printf("F = %.6f, exact %.6f\n", measured, exact);

  // The derivative with respect to the position is right when moving the sphere upwards by h
  // changes the energy by h int w, which is h 3/2 4 pi.
  const double h = 1e-4;
  const double slope = (energy(sphere, h) - energy(sphere, -h)) / (2 * h);
  std::printf("dF/dz = %.6f, exact %.6f\n", slope, 6 * std::numbers::pi);

  // And the first variation that all methods would use: int a for a normal displacement of 1 is the
  // derivative with respect to the radius. F = R^3 (4/5) pi for c = z / R, so it is 12/5 pi.
  double variation = 0;
  fem::for_each_point(*sphere.triangulation, sphere.positions, [&](const auto& sample) {
    model::SurfacePoint<double> point{};
    point.position = fem::vector_at(sphere.positions, sample);
    point.normal = sample.frame.normal;
    point.order_parameter = point.position.z;
    point.mean_curvature = -2;
    variation += sample.weight * model::variation_of_term<Weight>({}, point).a;
  });
  std::printf("dF/dR = %.6f, exact %.6f\n", variation, 2.4 * std::numbers::pi);

  // Results
  // -------
  // All three agree to the accuracy of the mesh. To make the term a part of the library, the struct
  // gets a name and goes into a header of its own in include/vesica/model, its type into the list
  // `Energies` of model/terms.hpp, and its two weights into model/material.hpp: see
  // docs/developing.md. The four methods, the tables and the files then have it.
  const bool is_right = std::abs(measured - exact) < 1e-3 &&
                        std::abs(slope - 6 * std::numbers::pi) < 1e-2 &&
                        std::abs(variation - 2.4 * std::numbers::pi) < 1e-2;
  return is_right ? 0 : 1;
}
