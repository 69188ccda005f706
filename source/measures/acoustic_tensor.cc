// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/kernels/kernels_point.h>
#include <myolines/measures/acoustic_tensor.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <vector>

namespace myolines
{
  namespace
  {
    /// dP_aA/dF_bB at 81 coefficients [3 a + b][3 A + B], rates frozen, pressure and dilatation taken point by point.
    void moduli(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p, double (&c)[81])
    {
      KernelModel model = kernel_model(parameters, activation);
      double      F[9], F_rate[9], identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
      for (unsigned int i = 0; i < 9; ++i)
        {
          F[i]      = p.F[i / 3][i % 3];
          F_rate[i] = p.F_rate[i / 3][i % 3];
        }
      const bool               muscle = p.material[material_passive] != 0 || p.material[material_active] != 0;
      const FibreTerms         terms{muscle,       muscle && model.active, model.rate, p.material[material_tendon] != 0, &model.activation,
                             &model.curves};
      const Kinematics<double> k(F);
      const PointLaw<double>   law(model, terms, p.material.data(), k, F_rate, p.pressure);
      double                   LF[9];
      if (model.rate)
        law.curvature(F_rate, LF);
      law.coefficients(identity, LF, 1, 0, 1., c, 9, 1);
      for (const TissuePart &part : parameters.tissue(p.material_id).laws)
        {
          double A[9][9]; // [3 a + A][3 b + B]
          part.law->moduli(deformation(parameters, activation, p, model.curves), 1, 0, A);
          for (unsigned int i = 0; i < 81; ++i)
            c[i] += weight_of(part, p) * A[3 * (i / 27) + i / 3 % 3][3 * (i / 9 % 3) + i % 3];
        }
      const VolumeEnergy<double> volume(parameters.volume_form, p.material[material_bulk]);
      const double               stiffness = volume.stiffness(p.dilatation) * p.J * p.J;
      for (unsigned int i = 0; i < 81; ++i)
        {
          const unsigned int a = i / 27, b = i / 9 % 3, A = i / 3 % 3, B = i % 3;
          c[i] += stiffness * k.H[3 * a + A] * k.H[3 * b + B];
        }
    }

    double smallest_eigenvalue(const double (&c)[81], const Vector3 &n)
    {
      dealii::SymmetricTensor<2, 3> Q;
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = a; b < 3; ++b)
          {
            double sum = 0;
            for (unsigned int A = 0; A < 3; ++A)
              for (unsigned int B = 0; B < 3; ++B)
                sum += (c[9 * (3 * a + b) + 3 * A + B] + c[9 * (3 * b + a) + 3 * A + B]) * n[A] * n[B];
            Q[a][b] = 0.5 * sum;
          }
      return dealii::eigenvectors(Q, dealii::SymmetricTensorEigenvectorMethod::jacobi)[2].first; // accurate beside kappa
    }
    struct Looked
    {
      double  value;
      Vector3 direction;
    };

    /// Goes down from @p best by steps of shrinking length in eight directions across it.
    double nearest_minimum(const double (&c)[81], Looked best)
    {
      for (double step = 0.1; step > 3e-4;)
        {
          const Vector3 &n = best.direction;
          Vector3        across; // along the axis from which the direction is furthest
          across[std::abs(n[0]) < std::abs(n[1]) ? (std::abs(n[0]) < std::abs(n[2]) ? 0 : 2) : (std::abs(n[1]) < std::abs(n[2]) ? 1 : 2)] =
              1;
          Vector3 first = cross_product_3d(n, across);
          first /= first.norm();
          const Vector3 second = cross_product_3d(n, first);
          Looked        next   = best;
          for (unsigned int i = 0; i < 8; ++i)
            {
              const double  angle = i * dealii::numbers::PI_4;
              const Vector3 there = n + step * (std::cos(angle) * first + std::sin(angle) * second), unit = there / there.norm();
              if (const double value = smallest_eigenvalue(c, unit); value < next.value)
                next = {value, unit};
            }
          if (next.value < best.value)
            best = next;
          else
            step /= 2;
        }
      return best.value;
    }
  } // namespace

  double smallest_acoustic_eigenvalue(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p)
  {
    double c[81];
    moduli(parameters, activation, p, c);
    // Directions spread evenly over a hemisphere along a spiral, then steps of shrinking length from the best ones: the smallest eigenvalue
    // has several minima, the best of the first directions need not lie beside the lowest, and where two eigenvalues cross it has edges.
    constexpr unsigned int n_directions = 200, n_refined = 6;
    const double           golden = dealii::numbers::PI * (3 - std::sqrt(5.));
    std::vector<Looked>    looked;
    for (unsigned int i = 0; i < n_directions; ++i)
      {
        const double  z = (i + 0.5) / n_directions, r = std::sqrt(1 - z * z);
        const Vector3 n({r * std::cos(golden * i), r * std::sin(golden * i), z});
        looked.push_back({smallest_eigenvalue(c, n), n});
      }
    std::partial_sort(looked.begin(), looked.begin() + n_refined, looked.end(),
                      [](const Looked &one, const Looked &other) { return one.value < other.value; });
    double smallest = looked.front().value;
    for (unsigned int i = 0; i < n_refined; ++i)
      smallest = std::min(smallest, nearest_minimum(c, looked[i]));
    return smallest;
  }
} // namespace myolines
