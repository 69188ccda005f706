// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/body_measures.h>

#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// The parts that a body has, in the order of Flexodeal's columns: total, volumetric, isochoric, then these.
  class StressParts
  {
  public:
    /// Those of the tissues that the cells of the body are made of, fat and laws.
    explicit StressParts(const Muscle3dParameters &parameters)
    {
      if (parameters.has_muscle)
        chosen_ = {{muscle_active, "Muscle active"}, {muscle_passive, "Muscle passive"}, {muscle_base, "Muscle base"}};
      if (parameters.tissues.count(aponeurosis_id) + parameters.tissues.count(tendon_id) > 0)
        for (const StressPart part : {aponeurosis_fibre, aponeurosis_base, tendon_fibre, tendon_base})
          chosen_.push_back({part, tendinous(part)});
      if (parameters.has_fat())
        chosen_.push_back({fat_part, "Fat"});
      for (const LawPart &law : parameters.law_parts())
        laws_.push_back(law.name);
    }

    /// Flexodeal writes "Apo" in its files of forces and "Aponeurosis" in that of energies.
    std::vector<std::string> names(const std::string &aponeurosis) const
    {
      std::vector<std::string> all{"Total", "Volumetric", "Isochoric"};
      for (auto [part, name] : chosen_)
        {
          if (part == aponeurosis_fibre || part == aponeurosis_base)
            name.insert(0, aponeurosis);
          all.push_back(name);
        }
      all.insert(all.end(), laws_.begin(), laws_.end());
      return all;
    }

    /// The numbers under names(), in the same order.
    template <typename T>
    std::vector<T> values(const Parts<T> &parts) const
    {
      std::vector<T> all{parts.total(), parts[volumetric_part], parts.isochoric()};
      for (const auto &[part, name] : chosen_)
        all.push_back(parts[part]);
      all.insert(all.end(), parts.laws.begin(), parts.laws.end());
      return all;
    }

  private:
    static std::string tendinous(const StressPart part)
    {
      return part == aponeurosis_fibre  ? " fibre"
             : part == aponeurosis_base ? " base"
             : part == tendon_fibre     ? "Tendon fibre"
                                        : "Tendon base";
    }

    std::vector<std::pair<StressPart, std::string>> chosen_;
    std::vector<std::string>                        laws_; ///< under the names of the scene
  };
} // namespace myolines
