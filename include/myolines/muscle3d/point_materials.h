// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/cell_batches.h>
#include <myolines/muscle3d/parameters.h>

#include <deal.II/base/aligned_vector.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// The material at every quadrature point of a set of batches (see MaterialValue): tissues, mixes and fields of a body, made
  /// once. Cells of a tissue without fields share one set of numbers.
  class PointMaterials
  {
  public:
    /// @p potential: of the space of the batches, for fibres between faces; else nullptr.
    PointMaterials(const Muscle3dParameters &parameters, const CellBatches &batches, const Element &element, const Vector *potential);

    /// n_material_values lanes of point q stand at values(b) + q * stride(b).
    const double *values(const unsigned int b) const { return &values_[batches_[b].first]; }
    /// doubles from one point to the next, 0 where all points of the batch are alike
    unsigned int stride(const unsigned int b) const { return batches_[b].stride; }
    /// Material of a point in one lane.
    Material at(unsigned int b, int q, unsigned int lane) const;
    /// What the fields get wrong on this rank, a sentence about "system/fields"; else empty.
    const std::string &problem() const { return problem_; }
    /// How many points of this rank have the activation of [0] no region, [1] the first, ...; counted where there are fields.
    const std::vector<unsigned int> &points_of_region() const { return points_of_region_; }
    /// Whether some point of the batch has such fibres.
    bool muscle(const unsigned int b) const { return batches_[b].muscle; }
    bool tendon(const unsigned int b) const { return batches_[b].tendon; } ///< those of tendon or aponeurosis

    /// Laws that are added on the points of the batch; borrowed.
    struct Laws
    {
      const LawTerm *terms; ///< the first of them
      int            n;     ///< how many there are
      double         shear; ///< their modulus at rest together [Pa], the largest of the tissues
    };
    /// Those of batch @p b.
    Laws laws(const unsigned int b) const
    {
      const Batch &batch = batches_[b];
      return {terms_.data() + batch.first_term, batch.n_terms, batch.shear};
    }

  private:
    struct Batch
    {
      std::size_t  first;
      unsigned int stride;
      bool         muscle, tendon;
      int          first_term = 0, n_terms = 0;
      double       shear = 0;
    };
    /// Of the tissues with the material ids from @p first to @p last.
    void set_laws(unsigned int first, unsigned int last, Batch &batch) const;

    class Gradients;
    void add_field(const MaterialField &field, const CellBatches &batches, const Element &element, unsigned int b, Gradients *gradients);

    dealii::AlignedVector<double>           values_;
    std::vector<Batch>                      batches_;
    std::vector<std::shared_ptr<const Law>> laws_;      ///< keeps those of the terms
    std::vector<LawTerm>                    terms_;     ///< tissue after tissue
    std::map<unsigned int, double>          law_shear_; ///< by tissue
    std::string                             problem_;
    std::vector<unsigned int>               points_of_region_;
  };
} // namespace myolines
