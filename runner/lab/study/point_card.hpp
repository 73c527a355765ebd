// The card of a point on a study's page: settings, error, time, work, pictures. HTML out.
#pragma once

#include "lab/study/report_html.hpp"

#include <string>

namespace tidemark::lab {

/// Of the point with that index, which was measured.
std::string point_card(const WorkPrecisionSet& set, const PageMedia& media, size_t point);

/// The picture, or where it lies. `whose`: the name of its point; empty: it is the reference.
std::string figure_of(const PagePicture& picture, const std::string& whose);

} // namespace tidemark::lab
