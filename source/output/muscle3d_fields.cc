#include <myolines/base/names.h>
#include <myolines/output/muscle3d_fields.h>
#include <myolines/output/text_file.h>

namespace myolines
{
  namespace
  {
    class Fields : public Observer
    {
    public:
      Fields(const scene::Node &fields, const Muscle3dSystem &system, std::filesystem::path folder, WorkLedger &ledger)
        : system_(system)
        , every_(fields.integer("every"))
        , names_(read_field_names(fields, field_names()))
        , folder_(std::move(folder))
        , ledger_(ledger)
      {}

      void begin(const State &state) override { write(state); }

      void accepted(const State &state, const StepRecord &record) override
      {
        if (record.number % every_ == 0)
          write(state);
      }

    private:
      void write(const State &state)
      {
        const WorkLedger::Timer timer(ledger_, "output fields");
        ledger_.count("field outputs");
        const auto        number = static_cast<unsigned int>(written_.size());
        const std::string file   = write_fields(system_, state, names_, folder_.string(), number);
        written_.emplace_back(state.t, std::filesystem::path(file).filename().string());
        replace_file(folder_ / "fields.pvd", pvd_text(written_));
      }

      const Muscle3dSystem                       &system_;
      std::size_t                                 every_;
      std::vector<std::string>                    names_;
      std::filesystem::path                       folder_;
      WorkLedger                                 &ledger_;
      std::vector<std::pair<double, std::string>> written_;
    };
  } // namespace

  scene::Schema fields_schema()
  {
    scene::Schema fields("Fields for ParaView: fields-NNNN.vtu and fields.pvd.");
    fields.integer("every", 1, scene::Range::closed(1, 1e9), "At the start and after every so many accepted steps.")
        .text("what", "displacement", "Names separated by commas, of: " + join(field_names()) + ".");
    return fields;
  }

  std::unique_ptr<Observer> make_fields(const scene::Node &fields, const Muscle3dSystem &system, const std::filesystem::path &folder,
                                        WorkLedger &ledger)
  {
    return std::make_unique<Fields>(fields, system, folder, ledger);
  }
} // namespace myolines
