#include "cli/app.h"
#include "vsplit/base/memory.h"

int main(int argc, char** argv) {
    vsplit::return_large_memory();
    return vsplit::cli::run(argc, argv);
}
