#pragma once

#include <array>
#include <string>
#include <vector>

#include "picture.h"
#include "rasterise.h"
#include "text.h"

namespace vsplit::render {

/// A mesh and what to call it.
struct Subject {
    std::string caption;
    TriangleMesh mesh;
};

/// Part of the main view to enlarge: its centre and width as shares of the view's width and height from the top left.
struct Detail {
    double x = 0.5;
    double y = 0.5;
    double width = 0.25;
};

/// What the sheet shows and how.
struct SheetOptions {
    std::string title;
    int panel_width = 860;   ///< pixels
    int panel_height = 680;  ///< pixels
    Camera camera;
    std::vector<Detail> details;
};

struct Typefaces {
    Typeface plain;
    Typeface bold;
};

/// Subjects side by side in one view: caption and figures, the whole, its details, and the histogram of stretch whose axis is
/// the scale of colours. \pre there is a subject, and every subject has a face.
[[nodiscard]] Picture draw_sheet(const std::vector<Subject>& subjects, const SheetOptions& options, const Typefaces& faces);

}  // namespace vsplit::render
