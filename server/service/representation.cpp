#include "service/representation.h"

#include <utility>
#include <variant>

#include "service/memory_use.h"

namespace vsplit::service {
namespace {

MethodFigures without_arrays(MethodFigures figures) {
    const auto clear = [](auto& options) {
        options.marked_edges = {};
        options.regions = {};
        if (options.sizing) options.sizing->field = {};
    };
    std::visit(clear, figures.options);
    return figures;
}

}  // namespace

Representation::Representation(std::string id, MethodRequest asked, MethodFigures figures, const MrrExtent& extent,
                               std::shared_ptr<Kept<Levels>> levels)
    : id_(std::move(id)),
      asked_(std::move(asked)),
      figures_(without_arrays(std::move(figures))),
      request_share_(levels->budget().charge(memory_of(asked_.options))),
      extent_(extent),
      levels_(std::move(levels)) {}

}  // namespace vsplit::service
