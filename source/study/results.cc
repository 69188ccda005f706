// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/compare/compare.h>
#include <myolines/output/checkpoint.h>
#include <myolines/scene/formula.h>
#include <myolines/study/csv_table.h>
#include <myolines/study/results.h>
#include <myolines/study/runner.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace myolines::study
{
  namespace
  {
    /// "; nearest: "force [N]"", or nothing if none is near.
    std::string nearest_among(const std::string &name, const std::vector<std::string> &known)
    {
      const std::string hint = nearest_hint(name, known);
      return hint.empty() ? "" : "; " + hint;
    }

    std::vector<std::string> files_beside(const std::filesystem::path &file)
    {
      std::vector<std::string> names;
      std::error_code          none; // a folder that cannot be read has no names
      for (const auto &entry : std::filesystem::directory_iterator(file.parent_path(), none))
        names.push_back(entry.path().filename().string());
      return names;
    }

    /// The part "counts" or "seconds" of a ledger.json; no object if it has none.
    nlohmann::json part_of_ledger(const Outcome &outcome, const std::string &part)
    {
      const auto ledger = nlohmann::json::parse(outcome.ledger, nullptr, /*allow_exceptions*/ false);
      return ledger.is_object() && ledger.contains(part) ? ledger[part] : nlohmann::json();
    }

    /// The measures of all cases, each file read once.
    class Evaluation
    {
    public:
      Evaluation(const std::map<std::string, Outcome> &outcomes, const std::filesystem::path &folder)
        : outcomes_(outcomes)
        , folder_(folder)
      {}

      bool is_done(const std::string &name) const
      {
        const auto found = outcomes_.find(name);
        return found != outcomes_.end() && found->second.status == "done";
      }

      Measured value(const Quantity &quantity, const Case &which)
      {
        forget_all_but(which);
        switch (quantity.source)
          {
          case Quantity::Source::column:
            return column(quantity, which);
          case Quantity::Source::state:
            return state(quantity.key == "displacement" ? "u" : "v", which);
          case Quantity::Source::field:
            return field(quantity.key, which);
          case Quantity::Source::count:
            return of_ledger("counts", quantity.key, which);
          case Quantity::Source::seconds:
            return of_ledger("seconds", quantity.key, which);
          }
        throw std::logic_error("unknown source of a quantity");
      }

    private:
      const std::optional<CsvTable> &table(const std::filesystem::path &file)
      {
        const auto found = tables_.find(file);
        return found != tables_.end() ? found->second : tables_.emplace(file, read_csv(file)).first->second;
      }

      /// Tables are kept for the other quantities of a case, and those of a reference for its other cases: no more, there may be thousands.
      void forget_all_but(const Case &which)
      {
        if (which.name == current_)
          return;
        current_                = which.name;
        const auto of_reference = case_folder(folder_, which.reference);
        for (auto entry = tables_.begin(); entry != tables_.end();)
          entry = entry->first.parent_path() == of_reference ? std::next(entry) : tables_.erase(entry);
      }

      std::optional<Series> series(const std::filesystem::path &file, const Quantity &quantity, std::string &note)
      {
        const std::optional<CsvTable> &csv = table(file);
        if (!csv)
          note = std::filesystem::exists(file)
                     ? file.filename().string() + " is no whole table"
                     : file.filename().string() + " is not there" + nearest_among(file.filename().string(), files_beside(file));
        else
          {
            for (const auto &[name, header] : quantity.columns)
              if (!csv->column(header))
                {
                  note = file.filename().string() + " has no column \"" + header + "\"" + nearest_among(header, csv->header);
                  return std::nullopt;
                }
            return quantity.formula.empty() ? series_of(*csv, quantity.column)
                                            : series_of_formula(*csv, quantity.formula, quantity.columns);
          }
        return std::nullopt;
      }

      Measured column(const Quantity &quantity, const Case &which)
      {
        std::string                 note;
        const std::optional<Series> whole = series(case_folder(folder_, which.name) / quantity.file, quantity, note);
        if (!whole)
          return {{}, note};
        const Series         part = window(*whole, quantity.from, quantity.until);
        const MeasureOptions options{quantity.relative, quantity.fraction};
        if (!quantity.is_error())
          return measure(quantity.measure, part, nullptr, options);
        const std::optional<std::vector<double>> reference = reference_values(quantity, which, part.t, note);
        return reference ? measure(quantity.measure, part, &*reference, options) : Measured{{}, note};
      }

      std::optional<std::vector<double>> reference_values(const Quantity &quantity, const Case &which, const std::vector<double> &t,
                                                          std::string &note)
      {
        if (quantity.reference_formula)
          {
            const VectorFormula formula(std::array<std::string, 3>{{*quantity.reference_formula, "0", "0"}});
            std::vector<double> values;
            for (const double instant : t)
              values.push_back(formula(0, dealii::Point<3>(), instant));
            return values;
          }
        if (!quantity.reference_file && !is_done(which.reference))
          {
            note = which.reference.empty() ? "" : "its reference is not done"; // a reference has none
            return std::nullopt;
          }
        const std::filesystem::path file =
            quantity.reference_file ? *quantity.reference_file : case_folder(folder_, which.reference) / quantity.file;
        const std::optional<Series> reference = series(file, quantity, note);
        if (!reference)
          return std::nullopt;
        const std::optional<std::vector<double>> values = reference_at(*reference, t);
        if (!values)
          note = "the reference does not cover its times";
        return values;
      }

      Measured state(const std::string &vector, const Case &which)
      {
        if (which.reference.empty())
          return {}; // it is one
        if (!is_done(which.reference))
          return {{}, "its reference is not done"};
        try
          {
            const std::vector<double> x = CheckpointReader(checkpoint_file(case_folder(folder_, which.name))).whole(vector);
            const std::vector<double> r = CheckpointReader(checkpoint_file(case_folder(folder_, which.reference))).whole(vector);
            if (x.size() != r.size())
              return {{}, "the reference has another mesh"};
            double difference = 0, size = 0;
            for (std::size_t i = 0; i < x.size(); ++i)
              {
                difference += (x[i] - r[i]) * (x[i] - r[i]);
                size += r[i] * r[i];
              }
            return size > 0 ? Measured{std::sqrt(difference / size), ""} : Measured{{}, "the reference is zero"};
          }
        catch (const InputError &error)
          {
            return {{}, error.problems().front().what};
          }
      }

      Measured field(const std::string &name, const Case &which)
      {
        if (which.reference.empty())
          return {}; // it is one
        if (!is_done(which.reference))
          return {{}, "its reference is not done"};
        try
          {
            for (const FieldDifference &difference : differences(which))
              if (difference.field == name)
                return {difference.relative(), difference.relative() ? "" : "the reference is zero"};
            return {{}, "the system has no " + name};
          }
        catch (const InputError &error)
          {
            return {{}, error.problems().front().what};
          }
      }

      /// Of all fields, as they cost no more than one; and the last reference, which the next case is likely to have too.
      const std::vector<FieldDifference> &differences(const Case &which)
      {
        if (const auto found = differences_.find(which.name); found != differences_.end())
          return found->second;
        const std::filesystem::path of_reference = checkpoint_file(case_folder(folder_, which.reference));
        if (!reference_ || reference_->file() != of_reference)
          reference_ = std::make_unique<const SavedState>(of_reference);
        const SavedState state(checkpoint_file(case_folder(folder_, which.name)));
        return differences_.emplace(which.name, l2_differences(state, *reference_)).first->second;
      }

      /// A run books only what it does: what others have and this one has not is 0. What none has may be misspelt.
      Measured of_ledger(const std::string &part, const std::string &key, const Case &which)
      {
        const nlohmann::json booked = part_of_ledger(outcomes_.at(which.name), part);
        if (!booked.is_object())
          return {{}, "there is no ledger"};
        if (booked.contains(key))
          return {booked[key].get<double>(), ""};
        const std::vector<std::string> &known = booked_by_any(part);
        if (std::find(known.begin(), known.end(), key) != known.end())
          return {0., ""};
        return {{}, "no case has \"" + key + "\" among the " + part + " of its ledger" + nearest_among(key, known)};
      }

      /// Names in that part of the ledgers of all cases that are done.
      const std::vector<std::string> &booked_by_any(const std::string &part)
      {
        if (const auto found = booked_.find(part); found != booked_.end())
          return found->second;
        std::set<std::string> names;
        for (const auto &[name, outcome] : outcomes_)
          if (is_done(name))
            if (const nlohmann::json booked = part_of_ledger(outcome, part); booked.is_object())
              for (const auto &entry : booked.items())
                names.insert(entry.key());
        return booked_.emplace(part, std::vector<std::string>(names.begin(), names.end())).first->second;
      }

      const std::map<std::string, Outcome>                    &outcomes_;
      const std::filesystem::path                             &folder_;
      std::map<std::filesystem::path, std::optional<CsvTable>> tables_;
      std::string                                              current_;     ///< name of the case that is asked
      std::map<std::string, std::vector<FieldDifference>>      differences_; ///< of cases
      std::unique_ptr<const SavedState>                        reference_;
      std::map<std::string, std::vector<std::string>>          booked_; ///< part of the ledgers -> names
    };

    SignalMeasures signal_measures(Evaluation &evaluation, const View &view, const Case &which)
    {
      const auto of_signal = [&](const std::string &measure) {
        Quantity quantity;
        quantity.file    = view.file;
        quantity.column  = view.column;
        quantity.columns = {{view.column, view.column}};
        quantity.measure = measure;
        return evaluation.value(quantity, which);
      };
      return {of_signal("overshoot"), of_signal("late overshoot"), of_signal("relative variation")};
    }
  } // namespace

  std::string stability_class(const View &view, const bool done, const SignalMeasures &signal)
  {
    if (!done)
      return "failed";
    if (signal.overshoot.note == not_finite)
      return "diverged";
    if (!signal.overshoot.value || !signal.late_overshoot.value || !signal.variation.value)
      return "unknown";
    if (*signal.late_overshoot.value > view.overshoot)
      return "diverged";
    return *signal.overshoot.value > view.overshoot || *signal.variation.value > view.variation ? "oscillating" : "stable";
  }

  std::vector<Row> evaluate(const Study &study, const std::vector<Case> &cases, const std::map<std::string, Outcome> &outcomes,
                            const std::filesystem::path &study_folder)
  {
    Evaluation       evaluation(outcomes, study_folder);
    std::vector<Row> rows;
    for (const Case &which : cases)
      {
        Row row;
        row.which          = &which;
        row.outcome.name   = which.name;
        row.outcome.status = "open";
        if (const auto found = outcomes.find(which.name); found != outcomes.end())
          row.outcome = found->second;
        const bool done = row.outcome.status == "done";
        for (const Quantity &quantity : study.quantities)
          row.values.push_back(done ? evaluation.value(quantity, which) : Measured{});
        const bool judged = study.view.kind == Kind::stability_map &&
                            (which.role == Case::Role::point || which.role == Case::Role::repeat) && row.outcome.status != "open";
        if (judged)
          row.stability = stability_class(study.view, done, done ? signal_measures(evaluation, study.view, which) : SignalMeasures{});
        rows.push_back(std::move(row));
      }
    take_repeats_together(study, rows);
    add_rates(study, rows);
    return rows;
  }
} // namespace myolines::study
