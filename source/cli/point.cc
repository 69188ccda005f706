// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/counted.h>
#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/muscle1d/isometric_chain.h>
#include <myolines/muscle1d/muscle_tendon_unit.h>
#include <myolines/muscle3d/parameters.h>
#include <myolines/output/text_file.h>

#include "point_sheets.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>

#include <unistd.h>

namespace myolines
{
  namespace
  {
    /// The laws of one tissue.
    class TissueLaw
    {
    public:
      TissueLaw(const TissueParameters &tissue, const curves::FibreCurves &curves)
        : material_(material(tissue))
        , curves_(curves)
        , muscle_(tissue.fibre.law == FibreLaw::muscle)
        , rate_(tissue.fibre.force_velocity)
      {}

      bool muscle() const { return muscle_; }

      /// Stress along the fibre [Pa].
      double fibre(const double stretch, const double strain_rate, const double activation) const
      {
        Activation a;
        a.level[0] = activation;
        const FibreTerms terms{muscle_, muscle_ && activation > 0, rate_, !muscle_, &a, &curves_};
        return finite(stretch * fibre_stress(material_.data(), terms, stretch, strain_rate).g, stretch, strain_rate);
      }

      /// Uniaxial Cauchy stress of the isotropic parts [Pa].
      double base(const double s) const
      {
        return finite(2 * (s * s - 1 / s) * Yeoh<>(material_.data() + material_yeoh).response(s * s + 2 / s).first, s, 0);
      }

    private:
      /// @throws InputError where the numbers end.
      static double finite(const double stress, const double stretch, const double strain_rate)
      {
        if (std::isfinite(stress) && std::isfinite(stretch) && std::isfinite(strain_rate))
          return stress;
        throw InputError(
            InputProblem{"--stretch, --strain-rate",
                         "the stress at stretch " + exact_text(stretch) + " and strain rate " + exact_text(strain_rate) + " is not finite",
                         "ranges in which stresses are finite", ""});
      }

      const Material             material_;
      const curves::FibreCurves &curves_;
      const bool                 muscle_, rate_;
    };

    /// All sheets of one tissue.
    class TissueSheets
    {
    public:
      TissueSheets(std::string name, TissueLaw law, const PointOptions &options)
        : name_(std::move(name))
        , law_(std::move(law))
        , folder_(options.folder)
        , stretches_(spaced(options.stretch, "--stretch", 0))
        , rates_(spaced(options.strain_rate, "--strain-rate", -1e9))
        , activations_(law_.muscle() ? options.activation : std::vector<double>{0})
      {}

      std::vector<study::Picture> write() const
      {
        std::vector<study::Picture> pictures{stretch_sheet(), base_sheet()};
        if (law_.muscle())
          {
            pictures.push_back(rate_sheet());
            pictures.push_back(surface());
          }
        return pictures;
      }

    private:
      std::vector<std::string> labels() const
      {
        if (!law_.muscle())
          return {"fibre"};
        std::vector<std::string> texts;
        for (const double a : activations_)
          texts.push_back(label_of_activation(a));
        return texts;
      }

      std::vector<double> at_all_activations(const double stretch, const double rate) const
      {
        std::vector<double> stress;
        for (const double a : activations_)
          stress.push_back(law_.fibre(stretch, rate, a));
        return stress;
      }

      study::Picture stretch_sheet() const
      {
        PointSheet sheet({folder_, name_ + "_stretch", "Fibre stress of " + name_ + " at rest", "stretch [-]", "stress [Pa]", " [Pa]"},
                         labels());
        for (const double s : stretches_)
          sheet.row(s, at_all_activations(s, 0));
        return sheet.finish();
      }

      study::Picture rate_sheet() const
      {
        PointSheet sheet(
            {folder_, name_ + "_strain_rate", "Fibre stress of " + name_ + " at stretch 1", "strain rate [-]", "stress [Pa]", " [Pa]"},
            labels());
        for (const double e : rates_)
          sheet.row(e, at_all_activations(1, e));
        return sheet.finish();
      }

      study::Picture base_sheet() const
      {
        PointSheet sheet({folder_, name_ + "_base", "Base material of " + name_ + ", uniaxial", "stretch [-]", "stress [Pa]", " [Pa]"},
                         {"base material"});
        for (const double s : stretches_)
          sheet.row(s, {law_.base(s)});
        return sheet.finish();
      }

      /// All stretches by all rates; the picture has a few rates.
      study::Picture surface() const
      {
        const std::size_t        shown = std::min<std::size_t>(6, rates_.size());
        std::vector<std::string> titles;
        std::vector<double>      rates;
        for (std::size_t i = 0; i < shown; ++i)
          {
            std::ostringstream text;
            rates.push_back(rates_[i * (rates_.size() - 1) / (shown - 1)]);
            text << std::setprecision(3) << "strain rate " << rates.back();
            titles.push_back(text.str());
          }
        CsvFile csv({folder_}, name_ + "_surface.csv", {"stretch [-]", "strain rate [-]", "fibre, fully active [Pa]"});
        for (const double s : stretches_)
          for (const double e : rates_)
            csv.row(std::vector<double>{s, e, law_.fibre(s, e, 1)});
        csv.close();
        study::Picture picture;
        picture.name    = name_ + "_surface";
        picture.title   = "Fibre stress of " + name_ + ", fully active";
        picture.x_label = "stretch [-]";
        picture.y_label = "stress [Pa]";
        picture.marks   = false;
        for (std::size_t i = 0; i < shown; ++i)
          {
            picture.curves.push_back({titles[i], {}});
            for (const double s : stretches_)
              picture.curves.back().points.emplace_back(s, law_.fibre(s, rates[i], 1));
          }
        return picture;
      }

      std::string           name_;
      TissueLaw             law_;
      std::filesystem::path folder_;
      std::vector<double>   stretches_, rates_, activations_;
    };

    void print(const std::string &name, const TissueLaw &law, std::ostream &out)
    {
      const double a = law.muscle() ? 1 : 0;
      out << name << (law.muscle() ? ", fully active at rest" : "") << "\n  stretch [-]   fibre [kPa]   base material [kPa]\n";
      for (int i = -4; i <= 6; ++i)
        {
          const double s = 1 + 0.1 * i;
          out << std::fixed << std::setprecision(1) << std::setw(9) << s << std::setprecision(3) << std::setw(17)
              << 1e-3 * law.fibre(s, 0, a) << std::setw(18) << 1e-3 * law.base(s) << "\n";
        }
    }
    std::vector<study::Picture> tissue_sheets(const Muscle3dParameters &parameters, const PointOptions &options, std::ostream &out)
    {
      const curves::FibreCurves   curves = parameters.fibre_curves();
      std::vector<study::Picture> pictures;
      const auto                  add = [&](std::vector<study::Picture> &&more) {
        pictures.insert(pictures.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
      };
      for (const auto &[id, tissue] : parameters.tissues)
        {
          const std::string &name = parameters.tissue_names[id - 1];
          if (id <= tissue_kinds().size() && (id != muscle_id || parameters.has_muscle))
            {
              const TissueLaw law(tissue, curves);
              add(TissueSheets(name, law, options).write());
              print(name, law, out);
            }
          if (!tissue.laws.empty())
            add(law_sheets({name, tissue, curves}, options, out));
        }
      return pictures;
    }

    std::optional<HillForce> hill_force(const scene::Node &system)
    {
      if (system.text("type") == "muscle-tendon unit")
        return read_muscle_tendon_unit(system).force;
      if (system.text("type") == "continuum muscle")
        return read_continuum_muscle(system).force;
      if (system.text("type") == "isometric chain")
        return read_isometric_chain(system).force;
      return std::nullopt;
    }
  } // namespace

  void point_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, PointOptions options, std::ostream &out)
  {
    if (options.folder.empty())
      options.folder = std::filesystem::path("results") / (scene.stem().string() + " point");
    for (const double a : options.activation)
      if (!(a >= 0 && a <= 1))
        throw InputError(InputProblem{"--activation", std::to_string(a), "numbers in [0, 1]", ""});
    const scene::Node  whole  = read_whole_scene(scene, overrides);
    const scene::Node &system = whole.section("system");
    on_writing_rank("output folder " + options.folder.string(), "a folder that can be made and written", "choose another one with --out",
                    [&] {
                      std::filesystem::create_directories(options.folder / "pictures");
                      if (access(options.folder.c_str(), W_OK) != 0)
                        throw std::runtime_error("it cannot be written");
                    });
    std::vector<study::Picture> pictures;
    if (system.text("type") == "muscle 3d")
      pictures = tissue_sheets(read_muscle3d(system), options, out);
    else if (const std::optional<HillForce> force = hill_force(system))
      pictures = hill_sheets(*force, options, out);
    else
      system.refuse("type", "\"" + system.text("type") + "\" has no muscle", "a muscle, in one or three dimensions");
    const std::size_t drawn = study::draw(pictures, options.folder / "pictures");
    out << "Tables and " << counted(drawn, "picture") << ", in " << options.folder.string() << std::endl;
  }
} // namespace myolines
