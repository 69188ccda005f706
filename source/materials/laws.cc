// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/materials/law_kind.h>

#include <laws_of_list.h>

namespace myolines
{
  namespace
  {
    LawKernelSets kernels_of_list(const unsigned int number)
    {
#if defined(__x86_64__)
      return {{law_kernels_baseline[number], law_kernels_avx2[number], law_kernels_avx512[number]}};
#else
      return {{law_kernels_baseline[number]}};
#endif
    }
  } // namespace

  Registry<LawKind> &law_kinds()
  {
    static Registry<LawKind> kinds("law", [] {
      std::deque<LawKind> all;
#define MYOLINES_LAW(file, law) all.push_back(law_kind<law>(kernels_of_list(static_cast<unsigned int>(all.size()))));
#include <myolines/materials/laws/list.def>
#undef MYOLINES_LAW
      return all;
    }());
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
