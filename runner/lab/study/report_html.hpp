// The page of a study that a person opens: one file, no network, whole without scripts. Text out.
#pragma once

#include "lab/study/work_precision.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct PagePicture {
    std::string label;  ///< "picture", "FLIP"
    std::string file;   ///< in the report's folder
    std::string source; ///< `data:image/png;base64,…`; empty: the page has a link to the file instead
};

/// What the page shows beside the numbers.
struct PageMedia {
    std::string view; ///< whose the pictures are
    std::optional<PagePicture> reference;
    std::vector<std::vector<PagePicture>> points; ///< one list for each; empty: none has any
};

std::string to_html(const WorkPrecisionSet& set, const PageMedia& media);

} // namespace tidemark::lab
