// The page that a person opens: self-contained, no network, no script but the slider's. Text out.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// A picture as `data:image/png;base64,…`.
struct EmbeddedPicture {
    std::string label;
    std::string source;
};

/// What the page shows beside the numbers.
struct PageMedia {
    std::vector<EmbeddedPicture> diagrams;
    std::vector<EmbeddedPicture> pictures; ///< the reference first; for the slider
    std::string pictures_view;             ///< whose they are
};

std::string to_html(const WorkPrecisionSet& set, const PageMedia& media);

} // namespace tidemark::lab
