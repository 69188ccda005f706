// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_options.h"

namespace myolines
{
  void add_flexodeal_options(CLI::App &command, FlexodealOptions &options)
  {
    command.add_option("parameters", options.parameters, "Its parameters")->required()->type_name("PARAMETERS.prm");
    command.add_option("strain", options.strain, "Control points of the strain; - if the parameters have a ramp, or nothing is pulled")
        ->type_name("STRAIN.dat");
    command.add_option("activation", options.activation, "Control points of the activation, unless the parameters have a ramp")
        ->type_name("ACTIVATION.dat");
    command.add_option("--out", options.scene, "The scene to write")->required()->type_name("SCENE.xml");
    command.add_option("--markers", options.markers, "Its list of markers")->type_name("FILE");
    command.add_option("--qp-table", options.points, "Its CSV file of properties at quadrature points")->type_name("FILE");
    command.add_option("--pressure", options.pressures, "Its pressures on faces")->type_name("FILE");
    CLI::Option *mesh =
        command.add_option("--mesh", options.mesh, "A mesh (Gmsh, VTK, Abaqus) instead of the body of the parameters")->type_name("FILE");
    command
        .add_option("--ends", options.ends,
                    "Names of its surfaces that are held and pulled; default: those with the numbers 0 and Pulling face ID")
        ->expected(2)
        ->type_name("SURFACE SURFACE")
        ->needs(mesh);
    command.add_option("--steps", options.steps, "Schedule of steps instead of its step size: \"4 x 0.025; 8 x 0.0125\"")
        ->type_name("STEPS");
  }
} // namespace myolines
