#include "apps/commands.hpp"

int main(int argc, char** argv) { return sketchloc::run_program(argc, argv, sketchloc::kCommands); }
