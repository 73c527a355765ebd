// The page of a study: one HTML file that needs no network, and is complete without scripts. Returns text.
#pragma once

#include "lab/study/work_precision.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct PagePicture {
    std::string label; ///< for example "picture" or "FLIP"
    std::string file; ///< in the report's folder
    std::string source; ///< `data:image/png;base64,…`; empty: the page links to the file
};

/// The pictures of the page.
struct PageMedia {
    std::string view; ///< name of the view that the pictures show
    std::optional<PagePicture> reference;
    std::vector<std::vector<PagePicture>> points; ///< one list for each point; empty if no point has any
};

std::string to_html(const WorkPrecisionSet& set, const PageMedia& media);

} // namespace tidemark::lab
