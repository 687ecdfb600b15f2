#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "service/kept.h"
#include "service/levels.h"
#include "service/method_request.h"
#include "vsplit/method/method_result.h"
#include "vsplit/mrr/mrr_extent.h"

namespace vsplit::service {

/// A finished representation of a session. What it says never changes. Its figures are always at hand; its levels are in memory
/// while there is room. Thread-safe.
class Representation {
public:
    /// What was asked for, its source as used.
    Representation(std::string id, MethodRequest asked, MethodFigures figures, const MrrExtent& extent,
                   std::shared_ptr<Kept<Levels>> levels);

    [[nodiscard]] const std::string& id() const { return id_; }
    [[nodiscard]] const MethodRequest& asked() const { return asked_; }
    [[nodiscard]] const MeshRef& source() const { return asked_.source; }
    [[nodiscard]] const MethodFigures& figures() const { return figures_; }
    [[nodiscard]] const MrrExtent& extent() const { return extent_; }

    [[nodiscard]] Kept<Levels>& levels() const { return *levels_; }

private:
    const std::string id_;
    const MethodRequest asked_;
    const MethodFigures figures_;  // without what may be as large as the mesh, which nobody is told
    const MemoryBudget::Share request_share_;
    const MrrExtent extent_;
    const std::shared_ptr<Kept<Levels>> levels_;
};

}  // namespace vsplit::service
