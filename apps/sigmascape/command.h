#pragma once

#include "command_parser.h"
#include "output.h"

namespace sigmascape::cli {

/// Each adds its subcommand, with examples in its help; its work runs when CLI11 has parsed the line.
void add_scene_command(Command app, Output& output);
void add_bake_command(Command app, Output& output);
void add_atlas_command(Command app, Output& output);
void add_render_command(Command app, Output& output);
void add_dataset_command(Command app, Output& output);
void add_compare_command(Command app, Output& output);
void add_plot_command(Command app, Output& output);
void add_demo_command(Command app, Output& output);
void add_results_command(Command app, Output& output);

}  // namespace sigmascape::cli
