// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/body/entries.h>
#include <myolines/muscle3d/activation.h>
#include <myolines/muscle3d/parameters.h>
#include <myolines/system/file_drive.h>
#include <myolines/system/zajac.h>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    Schema excitation_schema()
    {
      const Zajac usual;
      Schema      excitation = drive_schema("excitation", "-");
      excitation
          .number("activation time", usual.time_constant, "s", Range::positive(),
                  "tau of Zajac's equation tau a' = u - (beta + (1 - beta) u) a.")
          .number("deactivation ratio", usual.ratio, "-", Range{0, 1, true, false}, "beta of Zajac's equation.");
      return excitation;
    }

    void add_drives(Schema &schema)
    {
      schema.optional_section("activation", drive_schema("activation", "-")).optional_section("excitation", excitation_schema());
    }

    /// The drive in the list "activation", or that which Zajac's equation makes of the list "excitation"; nullptr for none, or zero.
    std::shared_ptr<const Drive> read_drive(const Node &node)
    {
      if (node.has("activation") && node.has("excitation"))
        node.refuse("excitation", "both \"activation\" and \"excitation\" are given", "one of them",
                    "the activation follows from the excitation by Zajac's equation");
      if (node.has("excitation"))
        {
          const Node                  &list = node.section("excitation");
          const Driven                 driven{"excitation", "-", Range::closed(0, 1)};
          std::shared_ptr<const Drive> excitation = make_drive(list, driven);
          refuse_values_outside(list, *excitation, driven.range, driven.quantity);
          if (excitation->identically_zero())
            return nullptr;
          return std::make_shared<ZajacActivation>(Zajac{list.number("activation time"), list.number("deactivation ratio")}, excitation);
        }
      if (!node.has("activation"))
        return nullptr;
      const Driven                 driven{"activation", "-", activation_range};
      std::shared_ptr<const Drive> activation = make_drive(node.section("activation"), driven);
      refuse_values_outside(node.section("activation"), *activation, driven.range, driven.quantity);
      return activation->identically_zero() ? nullptr : activation;
    }
  } // namespace

  void add_activation(Schema &system)
  {
    add_drives(system);
    Schema region("A part of the muscle with an activation, or excitation, of its own; none: it stays passive.");
    region.text("where", std::nullopt,
                "Formula of x, y, z [m] and volume (the number of the group of the cell in a mesh): the region is where it is positive, "
                "for example \"0.015-x\" or \"x<0.015\".");
    add_drives(region);
    system.optional_section(
        "activation regions",
        Schema("Parts of the muscle, each a list with a name of your choice; later ones cover earlier ones.").named_sections(region));
  }

  void read_activation(const Node &system, Muscle3dParameters &p)
  {
    p.activation = read_drive(system);
    if (!system.has("activation regions"))
      return;
    const Node &regions = system.section("activation regions");
    for (const Node &region : regions.named())
      {
        if (p.regions.size() + 1 == max_regions)
          regions.refuse(region.name(), "is one region too many", "at most " + std::to_string(max_regions - 1) + " regions");
        p.regions.push_back({region.name(), read_drive(region)});
        p.fields.regions.push_back(read_formula(region, "where", "volume"));
      }
  }

  bool Muscle3dParameters::active() const { return !activation_drives().empty(); }

  std::vector<const Drive *> Muscle3dParameters::activation_drives() const
  {
    std::vector<const Drive *> drives;
    if (activation)
      drives.push_back(activation.get());
    for (const ActivationRegion &region : regions)
      if (region.activation)
        drives.push_back(region.activation.get());
    return drives;
  }

  Activation Muscle3dParameters::activation_at(const double t, const Side side) const
  {
    Activation a;
    a.n_regions = 1 + static_cast<int>(regions.size());
    a.level[0]  = activation ? activation->value(t, side) : 0;
    for (unsigned int r = 0; r < regions.size(); ++r)
      a.level[r + 1] = regions[r].activation ? regions[r].activation->value(t, side) : 0;
    return a;
  }
} // namespace myolines
