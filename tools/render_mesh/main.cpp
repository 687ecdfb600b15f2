// render_mesh: meshes side by side, faces coloured by stretch, as a PNG.
#include <CLI/CLI.hpp>
#include <iostream>

#include "sheet.h"
#include "vsplit/io/read_mesh.h"

namespace vsplit::render {
namespace {

struct Arguments {
    std::string out;
    std::vector<std::string> subjects;
    std::vector<std::string> details;
    std::string title;
    std::string up = "z";
    std::array<double, 2> view{30, 25};
    std::string fonts = "/usr/share/fonts/truetype/dejavu";
    int width = 860;
    int height = 680;
};

void declare(CLI::App& app, Arguments& arguments) {
    app.add_option("out", arguments.out, "PNG to write")->required();
    app.add_option("subjects", arguments.subjects, "CAPTION=FILE, one to four; STL, OBJ, PLY or OFF")->required()->expected(1, 4);
    app.add_option("--detail", arguments.details, "X,Y,WIDTH: a part to enlarge, in shares of the view from its top left");
    app.add_option("--title", arguments.title, "line above all");
    app.add_option("--up", arguments.up, "axis of the mesh that points up")->check(CLI::IsMember({"x", "y", "z"}));
    app.add_option("--view", arguments.view, "azimuth and elevation of the eye, degrees")->delimiter(',');
    app.add_option("--fonts", arguments.fonts, "folder with DejaVuSans.ttf and DejaVuSans-Bold.ttf");
    app.add_option("--width", arguments.width, "pixels of a panel")->check(CLI::Range(200, 4000));
    app.add_option("--height", arguments.height, "pixels of a panel")->check(CLI::Range(200, 4000));
}

Expected<Subject> read_subject(const std::string& argument) {
    const std::size_t equals = argument.rfind('=');
    if (equals == std::string::npos) return Error{Cause::kInvalidOption, "'" + argument + "': expected CAPTION=FILE", "subjects"};
    Expected<ReadResult> read = read_mesh_file(argument.substr(equals + 1), {});
    if (!read) return read.error();
    if (read->mesh.faces.empty()) return Error{Cause::kEmptyInput, argument + ": the mesh has no faces", "subjects"};
    return Subject{argument.substr(0, equals), std::move(read->mesh)};
}

Expected<Detail> read_detail(const std::string& argument) {
    std::istringstream text(argument);
    Detail detail;
    char first = 0;
    char second = 0;
    const bool read = static_cast<bool>(text >> detail.x >> first >> detail.y >> second >> detail.width);
    if (!read || first != ',' || second != ',' || !(detail.width > 0 && detail.width <= 1)) {
        return Error{Cause::kInvalidOption, "'" + argument + "': expected X,Y,WIDTH with 0 < WIDTH <= 1, e.g. 0.5,0.5,0.25",
                     "detail"};
    }
    return detail;
}

Expected<SheetOptions> sheet_options(const Arguments& arguments) {
    SheetOptions options;
    options.title = arguments.title;
    options.panel_width = arguments.width;
    options.panel_height = arguments.height;
    options.camera = orbit_camera(arguments.up.front() - 'x', arguments.view[0], arguments.view[1]);
    for (const std::string& argument : arguments.details) {
        const Expected<Detail> detail = read_detail(argument);
        if (!detail) return detail.error();
        options.details.push_back(*detail);
    }
    return options;
}

Status render(const Arguments& arguments) {
    const Expected<SheetOptions> options = sheet_options(arguments);
    if (!options) return options.error();
    std::vector<Subject> subjects;
    for (const std::string& argument : arguments.subjects) {
        Expected<Subject> subject = read_subject(argument);
        if (!subject) return subject.error();
        subjects.push_back(*std::move(subject));
    }
    const std::filesystem::path fonts = arguments.fonts;
    Expected<Typeface> plain = Typeface::open(fonts / "DejaVuSans.ttf");
    if (!plain) return plain.error();
    Expected<Typeface> bold = Typeface::open(fonts / "DejaVuSans-Bold.ttf");
    if (!bold) return bold.error();
    return draw_sheet(subjects, *options, {*std::move(plain), *std::move(bold)}).write_png(arguments.out);
}

}  // namespace
}  // namespace vsplit::render

int main(int argc, char** argv) {
    CLI::App app("Draws meshes side by side, faces coloured by stretch, into a PNG.", "render_mesh");
    vsplit::render::Arguments arguments;
    vsplit::render::declare(app, arguments);
    CLI11_PARSE(app, argc, argv);
    const vsplit::Status done = vsplit::render::render(arguments);
    if (done) return 0;
    std::cerr << "render_mesh: " << vsplit::cause_name(done.error().cause) << ": " << done.error().message << '\n';
    return 1;
}
