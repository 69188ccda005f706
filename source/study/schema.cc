// SPDX-License-Identifier: LGPL-2.1-or-later
#include "axis.h"

#include <myolines/study/measures.h>
#include <myolines/study/study.h>

namespace myolines::study
{
  namespace
  {
    using scene::Range;
    using scene::Schema;

    Schema reference_schema(const std::string &doc)
    {
      Schema schema(doc);
      schema
          .text("settings", std::nullopt,
                "Parameters of the run, \"time/step=1e-4 | solver/nonlinear/relative tolerance=1e-12\"; they come after all others.")
          .text("instead of", "", "Axes that it does without, \"method | step\": one such run for every point of the remaining axes.");
      return schema;
    }

    /// What is made of a time series.
    Schema measured(Schema schema)
    {
      schema.text("file", std::nullopt, "CSV file of the case's folder, \"reaction.csv\"; its first column is the time.")
          .choice("measure", std::nullopt, measure_names(), "What is made of the column; doc/studies.md has the formulas.")
          .boolean("relative", false, "Errors are divided by the largest absolute value of the reference.")
          .number("fraction", 0.05, "-", {0, 1, true, true}, "Of the largest deviation, below which the decay time finds it decayed.")
          .optional_number("from", "s", Range::any(), "Rows before are left out.")
          .optional_number("until", "s", Range::any(), "Rows after are left out.")
          .optional_file("reference file", "CSV file with the time in its first column and the column, instead of a reference run.")
          .optional_text("reference formula", "Closed form in t [s], \"cos(t)\", instead of a reference run.");
      return schema;
    }

    Schema column_schema()
    {
      Schema schema("From a column of a time series.");
      schema.text("column", std::nullopt, "Header of the column, with its unit, for example \"Total [N]\".");
      return measured(schema);
    }

    Schema formula_schema()
    {
      Schema schema("From a formula of columns of a time series.");
      schema.text("formula", std::nullopt, "Formula in names of columns and t [s], \"total - passive\".")
          .text("columns", std::nullopt, "These names and the headers they stand for, \"total = Force [N] | passive = Passive force [N]\".")
          .text("unit", "", "Unit of the formula, \"N\".");
      return measured(schema);
    }

    Schema quantity_schema()
    {
      Schema state("Relative l2 difference of all unknowns at the end from those of the reference run, on the same mesh.");
      state.choice("of", "displacement", {"displacement", "velocity"}, "Which.");
      Schema field("Relative L2 difference of a field at the end from that of the reference run; meshes and degrees may differ.");
      field.choice("of", "displacement", {"displacement", "velocity", "pressure", "dilatation"}, "Which; a rod has the first two.");
      Schema count("A count of work, from ledger.json.");
      count.text("name", std::nullopt, "As the ledger calls it, \"newton iterations\"; one that never occurred is 0.");
      Schema seconds("Seconds of a phase, from ledger.json; they stand in seconds.csv.");
      seconds.text("name", std::nullopt, "As the ledger calls it, \"residual\".");
      return Schema("A number that every case is asked for.")
          .variant("type", "column",
                   {{"column", column_schema()},
                    {"formula", formula_schema()},
                    {"state", state},
                    {"field", field},
                    {"count", count},
                    {"seconds", seconds}},
                   "Where it comes from.");
    }

    Schema picture_schema()
    {
      Schema schema("Time series of the cases that are done, a panel for each column, a curve for each case.");
      schema.text("file", std::nullopt, "CSV file of the cases' folders, \"strain.csv\".")
          .text("columns", std::nullopt, "Headers of columns, with their units, \"a [m] | b [m]\".")
          .text("over", "", "Header of the column that is the abscissa; the first if empty, for example \"Stretch [-]\".")
          .text("of", "", "Only cases at these points of the axes, \"profile=ramp | mesh=coarse | mesh=fine\".")
          .boolean("logarithmic", false, "Whether the ordinate is; what is not positive is left out.")
          .optional_number("from", "", Range::any(), "Rows whose abscissa is before are left out.")
          .optional_number("until", "", Range::any(), "Rows whose abscissa is after are left out.");
      return schema;
    }

    std::vector<std::pair<std::string, Schema>> kinds()
    {
      Schema sweep("Quantities over parameters.");
      sweep.text("curves", "", "Axis whose points are curves of the pictures, for example \"activation\".")
          .text("together", "", "Quantities that share a picture, \"total | active | passive\".")
          .text("abscissa", "", "Axis along which the curves go, for example \"strain\"; the first with numbers if empty.");
      Schema work_precision("What an error costs: one curve for each method.");
      work_precision
          .text("curves", std::nullopt,
                "Axis whose points are the methods; there is one other, along which they become more accurate, for example \"method\".")
          .text("precision", std::nullopt, "Quantity that is the error, for example \"error in U\".")
          .text("work", "CPU seconds", "Quantity that is the cost, or \"CPU seconds\" of the process.")
          .optional_number("target", "", Range::positive(),
                           "Error at which equal_error.csv compares the costs, interpolated within each curve.");
      Schema convergence("Errors and their observed rates over the size of the steps or of the cells.");
      convergence.text("curves", "", "Axis whose points are the methods, for example \"method\".")
          .text("sizes", std::nullopt, "Axis with the sizes: of steps, or of cells as names of groups, for example \"step\".");
      Schema map("Every case is classed: stable, oscillating, diverged, failed; doc/studies.md has the rules.");
      map.text("abscissa", std::nullopt, "Axis of the map, for example \"step\".")
          .text("ordinate", std::nullopt, "Axis of the map; every point of the others gives a map of its own, for example \"method\".")
          .text("file", std::nullopt, "CSV file of the signal that is judged beside that of the reference, for example \"reaction.csv\".")
          .text("column", std::nullopt, "Header of its column, for example \"Total [N]\".")
          .number("overshoot limit", 1, "", Range::positive(),
                  "Above, in the last quarter of the time: diverged; before: oscillating. Over the range of the reference.")
          .number("variation limit", 1.5, "", {1, 1e300, true, false},
                  "Total variation above which it is oscillating, over that of the reference at the same times.");
      return {{"sweep", sweep}, {"work-precision", work_precision}, {"convergence", convergence}, {"stability map", map}};
    }
  } // namespace

  Schema study_schema()
  {
    Schema grids("Sets of axes; the study computes the points of all.");
    grids.named_sections(Schema("A set of axes, each crossed with the others.").named_sections(axis_schema()));
    Schema quantities("Columns of the table, beside class and rates.");
    quantities.named_sections(quantity_schema());
    Schema pictures("Pictures of time series, which `plot` draws beside those of the kind.");
    pictures.named_sections(picture_schema());
    Schema budget("When to stop.");
    budget.number("case", 3600, "s", Range::positive(), "Wall-clock time after which a case is ended; its row says so.")
        .number("total", 604800, "s", Range::positive(), "Wall-clock time after which the study ends; run again, it goes on.");

    Schema root("Many runs of one scene, what is measured of them, and how it is shown.");
    root.text("title", "", "What this study is about, for example \"Force over length\".")
        .file("scene", "Scene that all cases start from, relative to the study.")
        .text("settings", "", "Parameters for all cases and references, \"time/end=1 | solver/nonlinear/relative tolerance=1e-12\".")
        .integer("ranks", 1, Range::closed(1, 1e6), "MPI ranks of each run; above 1, mpirun of Open MPI starts it.")
        .integer("repeats", 1, Range::closed(1, 1000),
                 "Runs of each case, for seconds.csv: the median of their seconds and the spread. Their results must be equal.")
        .choice("interrupted cases", "restart", {"restart", "resume"},
                "Begin anew, so that counts and seconds are those of one run, or go on from their checkpoints.")
        .variant("kind", "sweep", kinds(), "What is to be seen.")
        .section("grids", grids)
        .optional_section("reference", reference_schema("Finer runs that cases are measured against; computed first."))
        .optional_section("cross check",
                          reference_schema("Runs by another method, measured against the reference: how far it can be trusted."))
        .section("quantities", quantities)
        .section("pictures", pictures)
        .section("budget", budget);
    return root;
  }
} // namespace myolines::study
