#include "service/representation.h"

#include <utility>

namespace vsplit::service {

Representation::Representation(std::string id, MethodRequest asked, MethodFigures figures, const MrrExtent& extent,
                               std::shared_ptr<Kept<Levels>> levels)
    : id_(std::move(id)), asked_(std::move(asked)), figures_(std::move(figures)), extent_(extent), levels_(std::move(levels)) {}

}  // namespace vsplit::service
