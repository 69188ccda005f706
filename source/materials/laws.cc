// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/materials/laws.h>

#include <laws_of_list.h>

namespace myolines
{
  namespace
  {
    scene::Range law_range(const Bound bound)
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

    template <class L>
    class LawOf : public Law
    {
    public:
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

    template <class L>
    LawKind law_kind(const unsigned int number)
    {
      return {number,
              L::name,
              L::doc,
              L::rates,
              has_energy<L>,
              has_hand_tangent<L>,
              L::stress_at_rest,
              law_schema<L>(),
              [number](const scene::Node *node) { return std::make_shared<const LawOf<L>>(law_kinds()[number], node); }};
    }
  } // namespace

  const std::vector<LawKind> &law_kinds()
  {
    static const std::vector<LawKind> kinds = [] {
      std::vector<LawKind> all;
#define MYOLINES_LAW(file, law) all.push_back(law_kind<law>(static_cast<unsigned int>(all.size())));
#include <myolines/materials/laws/list.def>
#undef MYOLINES_LAW
      return all;
    }();
    return kinds;
  }

  double Law::shear_modulus(const std::array<double, 3> &direction) const
  {
    Deformation<double> at;
    at.F          = plus_identity(Mat3<double>::zero(), 1.);
    at.F_rate     = Mat3<double>::zero();
    at.a0         = {{direction[0], direction[1], direction[2]}};
    at.activation = 0;
    double A[9][9], sum = 0;
    moduli(at, 1, 0, A);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (i != j)
          sum += A[3 * i + j][3 * i + j] + A[3 * i + j][3 * j + i];
    return sum / 12;
  }

  scene::Schema laws_schema()
  {
    std::vector<std::pair<std::string, scene::Schema>> alternatives;
    for (const LawKind &kind : law_kinds())
      alternatives.emplace_back(kind.name, kind.schema);
    return scene::Schema("Laws whose stresses are added, each a list with a name of your choice, under which its part is reported.")
        .named_sections(scene::Schema("A law and its parameters.").variant("type", std::nullopt, alternatives, "Which law."));
  }

  std::vector<TissuePart> read_laws(const scene::Node &laws)
  {
    std::vector<TissuePart> parts;
    for (const scene::Node &node : laws.named())
      for (const LawKind &kind : law_kinds())
        if (kind.name == node.text("type"))
          parts.push_back({node.name(), kind.make(&node), node.number("weight")});
    return parts;
  }
} // namespace myolines
