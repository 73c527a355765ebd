// Fuzzes the parsers of the lines that ffprobe and ffmpeg print about a video.
#include "fuzz.hpp"
#include "media/video_input.hpp"

#include <algorithm>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text = text_of(data, size);
    image::showinfo_start(text);
    const auto times = image::parse_video_times(text);
    if (!times) {
        REQUIRE(!times.error().empty());
        return 0;
    }
    REQUIRE(times->extent.width > 0 && times->extent.height > 0);
    REQUIRE(!times->starts.empty() && times->end > times->starts.back());
    REQUIRE(std::is_sorted(times->starts.begin(), times->starts.end()));
    REQUIRE(times->duration() > 0.0);
    for (const double seconds : {0.0, 1.0, -1.0, 1e300, times->duration()})
        REQUIRE(times->frame_at(seconds) < times->starts.size());
    return 0;
}
