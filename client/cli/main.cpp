#include "cli/app.h"

int main(int argc, char** argv) { return vsplit::cli::run(argc, argv); }
