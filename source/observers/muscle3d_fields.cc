// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/measures/fields.h>
#include <myolines/observers/muscle3d_fields.h>
#include <myolines/observers/places.h>
#include <myolines/output/periodic_output.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/data_out_base.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// What fields are written of and to.
    struct FieldOutput
    {
      const Muscle3dSystem    &system;
      std::vector<std::string> names;
      std::filesystem::path    folder;
    };

    std::string numbered(const std::string &before, const std::size_t number, const std::string &after)
    {
      std::ostringstream name;
      name << before << std::setw(4) << std::setfill('0') << number << after;
      return name.str();
    }

    /// One written instant. What `variant` means depends on the format.
    struct Instant
    {
      double      t; ///< [s]
      std::size_t variant;
    };
    using WrittenInstants = std::vector<Instant>;

    /// A format writes the fields of one more instant and lists all in a file for ParaView.
    class Format
    {
    public:
      virtual ~Format()                                                                           = default;
      virtual void write(const FieldOutput &output, const State &state, WrittenInstants &written) = 0;
    };

    /// fields-NNNN.vtu and fields.pvd; variant 1: fields_NNNN.pvtu, written by several ranks.
    class Vtu : public Format
    {
    public:
      void write(const FieldOutput &output, const State &state, WrittenInstants &written) override
      {
        const auto        number = static_cast<unsigned int>(written.size());
        const std::string file   = write_fields_vtu(output.system, state, output.names, output.folder.string(), number);
        written.push_back({state.t, std::filesystem::path(file).extension() == ".pvtu" ? 1u : 0u});
        std::vector<std::pair<double, std::string>> files;
        for (std::size_t i = 0; i < written.size(); ++i)
          files.emplace_back(written[i].t, written[i].variant == 1 ? numbered("fields_", i, ".pvtu") : numbered("fields-", i, ".vtu"));
        replace_file(output.folder / "fields.pvd", pvd_text(files));
      }
    };

    /// fields-NNNN.h5, fields-mesh-NNNN.h5 and fields.xdmf; the variant is the number of the mesh, which every run writes anew, as
    /// it depends on the ranks.
    class Hdf5 : public Format
    {
    public:
      void write(const FieldOutput &output, const State &state, WrittenInstants &written) override
      {
        const std::size_t number = written.size();
        const bool        first  = !mesh_;
        mesh_                    = mesh_.value_or(number);
        write_fields_hdf5(output.system, state, output.names, output.folder.string(), numbered("fields-", number, ".h5"),
                          first ? std::make_optional(mesh_name(number)) : std::nullopt);
        written.push_back({state.t, *mesh_});
        replace_file(output.folder / "fields.xdmf", xdmf_text(output, written));
      }

    private:
      static std::string mesh_name(const std::size_t number) { return numbered("fields-mesh-", number, ".h5"); }

      static std::string xdmf_text(const FieldOutput &output, const WrittenInstants &written)
      {
        const FieldSizes sizes = field_sizes(output.system);
        std::string      text  = "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
                                 "    <Grid Name=\"CellTime\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
        for (std::size_t i = 0; i < written.size(); ++i)
          {
            dealii::XDMFEntry entry(mesh_name(written[i].variant), numbered("fields-", i, ".h5"), written[i].t, sizes.points, sizes.cells,
                                    3);
            for (const std::string &name : output.names)
              entry.add_attribute(field_label(name), is_vector_field(name) ? 3 : 1);
            text += entry.get_xdmf_content(3, dealii::ReferenceCells::Hexahedron);
          }
        return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
      }

      std::optional<std::size_t> mesh_;
    };

    std::vector<double> read_instants(const scene::Node &fields)
    {
      if (!fields.has("at"))
        return {};
      if (fields.written("every"))
        fields.refuse("at", "is given beside \"every\"", "one of the two");
      return one_list(fields.numbers("at", "times [s]"));
    }

    class Fields : public PeriodicOutput
    {
    public:
      Fields(const scene::Node &fields, const Muscle3dSystem &system, const OutputFolder &folder, WorkLedger &ledger)
        : PeriodicOutput(fields.integer("every"), read_instants(fields))
        , output_{system, read_names(fields, field_names(system.parameters()), "field"), folder.path}
        , memory_("fields, " + fields.text("format"))
        , ledger_(ledger)
      {
        if (!system.line_of_action().line && std::count(output_.names.begin(), output_.names.end(), "pennation") > 0)
          fields.refuse("what",
                        "pennation is the angle to the line of action, which the body does not have: " + system.line_of_action().why_none,
                        "other fields, or a list \"line of action\" in \"system\"");
        if (fields.text("format") == "hdf5")
          {
            format_ = std::make_unique<Hdf5>();
            for (const char *name : {"fields-*.h5", "fields-mesh-*.h5", "fields.xdmf"})
              folder.note(name);
            memory_ += ": " + fields.text("what"); // fields.xdmf lists the same fields at all times
          }
        else
          {
            format_ = std::make_unique<Vtu>();
            for (const char *name : {"fields-*.vtu", "fields_*.vtu", "fields_*.pvtu", "fields.pvd"})
              folder.note(name);
          }
        if (folder.saved != nullptr && folder.saved->has_numbers(memory_))
          for (auto value = folder.saved->numbers(memory_).begin(); value != folder.saved->numbers(memory_).end(); value += 2)
            written_.push_back({value[0], static_cast<std::size_t>(value[1])});
      }

      void save(Archive &archive) const override
      {
        std::vector<double> values;
        for (const Instant &instant : written_)
          values.insert(values.end(), {instant.t, static_cast<double>(instant.variant)});
        archive.put_numbers(memory_, values);
      }

    private:
      void write(const State &state, Side, std::size_t) override
      {
        const WorkLedger::Timer timer(ledger_, "output fields");
        ledger_.count("field outputs");
        format_->write(output_, state, written_);
      }

      FieldOutput             output_;
      std::string             memory_;
      std::unique_ptr<Format> format_;
      WorkLedger             &ledger_;
      WrittenInstants         written_;
    };
  } // namespace

  scene::Schema field_output_schema()
  {
    scene::Schema fields("Fields for ParaView.");
    fields.integer("every", 1, scene::Range::closed(1, 1e9), "At the start, after every so many accepted steps, and at the end.")
        .optional_text("at", "Times [s] separated by spaces at which to write instead: steps end there, and the start may be one.")
        .text("what", "displacement",
              "Names separated by commas, of: " + join(field_names()) +
                  "; and of each law of a tissue its stress, by both names: stress of myocardium wall.")
        .choice(
            "format", "vtu", {"vtu", "hdf5"},
            "vtu: fields-NNNN.vtu with high-order cells, a file for each rank, listed in fields.pvd; hdf5: fields-NNNN.h5, one file for "
            "all ranks, listed in fields.xdmf.");
    return fields;
  }

  std::unique_ptr<Observer> make_fields(const scene::Node &fields, const Muscle3dSystem &system, const OutputFolder &folder,
                                        WorkLedger &ledger)
  {
    return std::make_unique<Fields>(fields, system, folder, ledger);
  }
} // namespace myolines
