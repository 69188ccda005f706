// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/laws.h>

namespace myolines
{
  namespace law_parts
  {
    /// As a range of a scene.
    inline scene::Range law_range(const Bound bound)
    {
      return bound == Bound::positive       ? scene::Range::positive()
             : bound == Bound::not_negative ? scene::Range::not_negative()
                                            : scene::Range::any();
    }

    /// Its declaration, in the words that the struct has for its members.
    template <class L>
    scene::Schema law_schema()
    {
      scene::Schema schema(L::doc);
      L             usual;
      usual.parameters([&](double &value, const char *name, const char *unit, const Bound bound, const char *doc) {
        schema.number(name, value, unit, law_range(bound), doc);
      });
      schema.number("weight", 1, "-", scene::Range::not_negative(), "Multiplies the stress: the share of this law in the tissue.");
      return schema;
    }

    /// A law of the struct L.
    template <class L>
    class LawOf : public Law
    {
    public:
      /// With the parameters of @p node; nullptr: with its defaults.
      LawOf(const LawKind &kind, const scene::Node *node)
        : Law(kind)
      {
        if (node != nullptr)
          law_.parameters([&](double &value, const char *name, const char *, Bound, const char *) { value = node->number(name); });
      }

      Mat3<double>          stress(const Strain<double> &s) const override { return law_.stress(s); }
      std::optional<double> energy([[maybe_unused]] const Strain<double> &s) const override
      {
        if constexpr (has_energy<L>)
          return law_.energy(s);
        else
          return std::nullopt;
      }
      void moduli(const Deformation<double> &at, const double w_u, const double w_v, double (&A)[9][9]) const override
      {
        myolines::moduli(law_, at, w_u, w_v, A);
      }
      const void *data() const override { return &law_; }

    private:
      L law_;
    };
  } // namespace law_parts

  /// What scenes and help need of a law, from its struct (law.h), with its kernels (law_batch.h).
  template <class L>
  LawKind law_kind(const LawKernelSets &kernels)
  {
    return {L::name,
            L::doc,
            L::rates,
            has_energy<L>,
            has_hand_tangent<L>,
            L::stress_at_rest,
            law_parts::law_schema<L>(),
            [](const scene::Node *node) { return std::make_shared<const law_parts::LawOf<L>>(*law_kinds().find(L::name), node); },
            kernels};
  }
} // namespace myolines
