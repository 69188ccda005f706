#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# study_pictures.sh PROGRAM SOURCE RESULTS: runs the studies behind doc/results/kinks.md and doc/results/stability.md, and those that convergence.md and
# error_control.md begin with, in RESULTS, where a study that is done is not
# run again, and puts the pictures of these pages, and the forces of doc/muscle_tendon_units.md, into SOURCE/doc/pictures.
set -eu
program=$1 source=$2 results=$3

# study STUDY, then pairs of a picture that it draws, with its extension, and its name in doc/pictures.
study()
{
  name=$1
  shift
  "$program" study "$source/input/studies/$name.xml" --out "$results/$name"
  "$program" plot "$results/$name"
  while [ $# -gt 0 ]; do
    cp "$results/$name/pictures/$1" "$source/doc/pictures/$2.${1##*.}"
    shift 2
  done
}

study chapter4_rod ramp__close_up.svg kinks_rod sine__steps_that_methods_choose.png kinks_rod_steps \
  smooth_strain_rates.png figure_4.3_rod ramp_strains.png figure_4.4_rod sine_strains.png figure_4.5_rod \
  ramp_strain_rates__0.58_to_0.65_s.png figure_4.6_rod sine_strain_rates__0_to_0.25_s.png figure_4.7_rod \
  ramp__implicit-explicit_scheme_of_the_thesis.png figure_4.8_rod sine_strain_rates_sundials__0_to_0.25_s.png figure_4.9_rod
study chapter4_block isotropic_ramp__close_up.svg kinks_bar_isotropic passive_ramp__close_up.svg kinks_bar_passive \
  active_ramp__close_up.svg kinks_bar_active \
  active_smooth_strain_rates.png figure_4.3_active active_ramp_strains.png figure_4.4_active \
  active_sine_strains.png figure_4.5_active \
  isotropic_ramp_strain_rates__0.58_to_0.65_s.png figure_4.6_isotropic active_ramp_strain_rates__0.58_to_0.65_s.png figure_4.6_active \
  isotropic_sine_strain_rates__0_to_0.25_s.png figure_4.7_isotropic active_sine_strain_rates__0_to_0.25_s.png figure_4.7_active \
  isotropic_ramp__implicit-explicit_scheme_of_the_thesis.png figure_4.8_isotropic \
  passive_ramp__implicit-explicit_scheme_of_the_thesis.png figure_4.8_passive \
  active_sine_strain_rates_sundials__0_to_0.25_s.png figure_4.9_active
study chapter4_pennate active_smooth_strain_rates.png figure_4.3_pennate active_ramp_strains.png figure_4.4_pennate \
  active_sine_strains.png figure_4.5_pennate active_ramp_strain_rates__0.58_to_0.65_s.png figure_4.6_pennate \
  active_sine_strain_rates__0_to_0.25_s.png figure_4.7_pennate passive_ramp__implicit-explicit_scheme_of_the_thesis.png figure_4.8_pennate
study stability_stress map_0.05.svg stability_0.05 map_0.01.svg stability_0.01 map_0.001.svg stability_0.001
study stability_short map_1e_4.svg stability_short_1e-4 map_1e_5.svg stability_short_1e-5
study convergence_time_all error_in_V_over_step.svg orders_in_time
study error_control_oscillator error_of_u_over_tolerance.svg error_by_tolerance
study energy_drift_rod
study energy_drift_block

"$program" point "$source/input/one_dimensional/isometric_chain.xml" --set "system/base material fraction=0.0015" --stretch 0.5 1.7 241 \
  --out "$results/base_material"
cp "$results/base_material/pictures/muscle_parts.svg" "$source/doc/pictures/base_material.svg"
