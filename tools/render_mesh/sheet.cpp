#include "sheet.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "vsplit/quality/mesh_quality.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::render {
namespace {

constexpr int kMargin = 36;
constexpr int kGap = 28;
constexpr int kTitleHeight = 64;
constexpr int kCaptionHeight = 76;
constexpr int kHistogramHeight = 150;
constexpr int kAxisHeight = 84;
constexpr int kTitleSize = 34;
constexpr int kCaptionSize = 27;
constexpr int kTextSize = 20;

/// 49876 -> "49,876".
std::string grouped(std::uint32_t number) {
    std::string digits = std::to_string(number);
    for (auto place = static_cast<std::ptrdiff_t>(digits.size()) - 3; place > 0; place -= 3) {
        digits.insert(static_cast<std::size_t>(place), ",");
    }
    return digits;
}

std::string fixed(double number, int decimals) {
    std::ostringstream text;
    text.setf(std::ios::fixed);
    text.precision(decimals);
    text << number;
    return text.str();
}

std::string figures(const Quality& quality) {
    return grouped(quality.faces) + " faces    stretch mean " + fixed(quality.stretch_mean, 3) + ", min " +
           fixed(quality.stretch_min, 3) + "    below 0.2: " + grouped(quality.faces_below_02);
}

/// The largest size up to `size` at which the text is no wider than `width`.
int fitting_size(const Typeface& face, int size, int width, const std::string& text) {
    while (size > 8 && face.width(size, text) > width) --size;
    return size;
}

struct Column {
    const Subject* subject = nullptr;
    Quality quality;
    int left = 0;
};

class Sheet {
public:
    Sheet(const std::vector<Subject>& subjects, const SheetOptions& options, const Typefaces& faces);
    [[nodiscard]] Picture draw();

private:
    void draw_captions();
    void draw_views();
    void draw_detail(const Detail& detail);
    void mark_detail(const Detail& detail, const Column& column);
    void draw_histogram(const Column& column);
    void draw_scale(const Column& column);
    [[nodiscard]] int detail_height() const { return options_->panel_height * 3 / 5; }
    [[nodiscard]] Picture view_of(const Column& column, const View& view, int height) const {
        return draw_mesh(column.subject->mesh, options_->camera, view, options_->panel_width, height);
    }

    const SheetOptions* options_;
    const Typefaces* faces_;
    std::vector<Column> columns_;
    View view_;
    int views_top_;
    int row_ = 0;  // where the next row of the sheet begins
    Picture picture_;
};

int sheet_width(std::size_t columns, const SheetOptions& options) {
    return 2 * kMargin + static_cast<int>(columns) * (options.panel_width + kGap) - kGap;
}

int sheet_height(const SheetOptions& options) {
    const int details = static_cast<int>(options.details.size()) * (options.panel_height * 3 / 5 + kGap);
    return 2 * kMargin + (options.title.empty() ? 0 : kTitleHeight) + kCaptionHeight + options.panel_height + kGap + details +
           kHistogramHeight + kAxisHeight;
}

Sheet::Sheet(const std::vector<Subject>& subjects, const SheetOptions& options, const Typefaces& faces)
    : options_(&options),
      faces_(&faces),
      views_top_(kMargin + (options.title.empty() ? 0 : kTitleHeight) + kCaptionHeight),
      picture_(sheet_width(subjects.size(), options), sheet_height(options), kPaper) {
    std::vector<const TriangleMesh*> meshes;
    for (const Subject& subject : subjects) {
        const int left = kMargin + static_cast<int>(columns_.size()) * (options.panel_width + kGap);
        columns_.push_back({&subject, measure_quality(subject.mesh), left});
        meshes.push_back(&subject.mesh);
    }
    view_ = fit_view(options.camera, meshes, options.panel_width, options.panel_height);
}

void Sheet::draw_captions() {
    if (!options_->title.empty()) faces_->bold.draw(picture_, kMargin, kMargin + kTitleSize, kTitleSize, kInk, options_->title);
    for (const Column& column : columns_) {
        const std::string& caption = column.subject->caption;
        const int caption_size = fitting_size(faces_->bold, kCaptionSize, options_->panel_width, caption);
        faces_->bold.draw(picture_, column.left, views_top_ - 44, caption_size, kInk, caption);
        const std::string line = figures(column.quality);
        const int line_size = fitting_size(faces_->plain, kTextSize, options_->panel_width, line);
        faces_->plain.draw(picture_, column.left, views_top_ - 14, line_size, kInk, line);
    }
}

void Sheet::draw_views() {
    for (const Column& column : columns_) picture_.paste(view_of(column, view_, options_->panel_height), column.left, views_top_);
    row_ = views_top_ + options_->panel_height + kGap;
}

void Sheet::draw_detail(const Detail& detail) {
    View part = view_;
    part.centre_x += (detail.x - 0.5) * options_->panel_width * view_.units_per_pixel;
    part.centre_y -= (detail.y - 0.5) * options_->panel_height * view_.units_per_pixel;
    part.units_per_pixel *= detail.width;
    for (const Column& column : columns_) {
        picture_.paste(view_of(column, part, detail_height()), column.left, row_);
        picture_.outline({column.left, row_, options_->panel_width, detail_height()}, kInk, 2);
        mark_detail(detail, column);
    }
    row_ += detail_height() + kGap;
}

/// Frames the enlarged part in the view of the whole.
void Sheet::mark_detail(const Detail& detail, const Column& column) {
    const int width = static_cast<int>(detail.width * options_->panel_width);
    const int height = static_cast<int>(detail.width * detail_height());
    const int left = static_cast<int>(detail.x * options_->panel_width) - width / 2;
    const int top = static_cast<int>(detail.y * options_->panel_height) - height / 2;
    picture_.outline({column.left + left - 2, views_top_ + top - 2, width + 4, height + 4}, kPaper, 2);
    picture_.outline({column.left + left, views_top_ + top, width, height}, kInk, 2);
}

void Sheet::draw_histogram(const Column& column) {
    const auto bins = static_cast<int>(column.quality.stretch_histogram.size());
    double highest = 0;
    for (const Column& any : columns_) {
        const std::uint32_t most = *std::max_element(any.quality.stretch_histogram.begin(), any.quality.stretch_histogram.end());
        highest = std::max(highest, static_cast<double>(most) / any.quality.faces);
    }
    for (int bin = 0; bin < bins; ++bin) {
        const double share =
            static_cast<double>(column.quality.stretch_histogram[static_cast<std::size_t>(bin)]) / column.quality.faces;
        const int height = static_cast<int>(std::lround(share / highest * (kHistogramHeight - 26)));
        const int left = column.left + options_->panel_width * bin / bins;
        const int right = column.left + options_->panel_width * (bin + 1) / bins;
        const int top = row_ + kHistogramHeight - height;
        picture_.fill({left + 2, top, right - left - 4, height}, stretch_colour((bin + 0.5) / bins));
        if (share < 0.0005) continue;
        const std::string label = fixed(100 * share, 1);
        faces_->plain.draw(picture_, (left + right - faces_->plain.width(14, label)) / 2, top - 5, 14, kPaleInk, label);
    }
}

/// The scale of colours, which is the histogram's axis.
void Sheet::draw_scale(const Column& column) {
    const int top = row_ + kHistogramHeight + 2;
    for (int x = 0; x < options_->panel_width; ++x) {
        picture_.fill({column.left + x, top, 1, 14}, stretch_colour((x + 0.5) / options_->panel_width));
    }
    for (int tick = 0; tick <= 5; ++tick) {
        const std::string label = fixed(0.2 * tick, 1);
        const int width = faces_->plain.width(kTextSize, label);
        const int x = column.left + options_->panel_width * tick / 5;
        const int left = std::clamp(x - width / 2, column.left, column.left + options_->panel_width - width);
        faces_->plain.draw(picture_, left, top + 36, kTextSize, kInk, label);
    }
    const std::string label = "stretch: 1 equilateral, 0 degenerate, below 0.2 unfit for solvers;  bars: % of faces";
    const int size = fitting_size(faces_->plain, kTextSize - 1, options_->panel_width, label);
    faces_->plain.draw(picture_, column.left, top + 66, size, kPaleInk, label);
}

Picture Sheet::draw() {
    draw_captions();
    draw_views();
    for (const Detail& detail : options_->details) draw_detail(detail);
    for (const Column& column : columns_) {
        draw_histogram(column);
        draw_scale(column);
    }
    return picture_;
}

}  // namespace

Picture draw_sheet(const std::vector<Subject>& subjects, const SheetOptions& options, const Typefaces& faces) {
    return Sheet(subjects, options, faces).draw();
}

}  // namespace vsplit::render
