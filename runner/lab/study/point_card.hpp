// The card of a point on a study's page: settings, error, time, work, pictures. Returns HTML.
#pragma once

#include "lab/study/report_html.hpp"

#include <string>

namespace tidemark::lab {

/// Takes the index of a point that was measured.
std::string point_card(const WorkPrecisionSet& set, const PageMedia& media, size_t point);

/// Returns the picture, or a link to its file. `whose` is the name of its point; empty: it is the reference.
std::string figure_of(const PagePicture& picture, const std::string& whose);

} // namespace tidemark::lab
