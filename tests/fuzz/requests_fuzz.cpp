// Fuzzes the values of options: frames, date, mouse, camera, size and output. The first byte chooses the
// option, the rest is the text.
#include "fuzz.hpp"
#include "host/frame_files.hpp"
#include "host/requests.hpp"

#include <algorithm>
#include <cmath>

using namespace tidemark;

namespace {

template <class T>
bool taken(const Result<T>& result) {
    REQUIRE(result || (result.error().code == ErrorCode::usage && !result.error().message.empty()));
    return result.has_value();
}

void check_frames(std::string_view text) {
    const auto frames = host::parse_frames(text);
    if (!taken(frames))
        return;
    REQUIRE(!frames->empty() && frames->size() <= 10'000'000);
    const auto [least, most] = std::minmax_element(frames->begin(), frames->end());
    REQUIRE(*least >= 0 && *most <= 100'000'000);
}

void check_date(std::string_view text) {
    const auto date = render::parse_date(text);
    if (!taken(date))
        return;
    REQUIRE(date->year >= 0 && date->year <= 9999);
    REQUIRE(date->month >= 0 && date->month <= 11);
    REQUIRE(date->day >= 1 && date->day <= 31);
    REQUIRE(date->seconds >= 0 && date->seconds < 86401);
}

void check_mouse(std::string_view text) {
    const auto parsed = host::parse_mouse(text);
    if (!taken(parsed))
        return;
    const glm::vec4 mouse = parsed->uniform();
    for (int i = 0; i < 4; ++i)
        REQUIRE(std::isfinite(mouse[i]) && std::floor(mouse[i]) == mouse[i]);
}

void check_camera(std::string_view text) {
    const auto camera = render::parse_camera(text);
    if (!taken(camera))
        return;
    REQUIRE(camera->azimuth >= 0 && camera->azimuth < 360);
    REQUIRE(std::abs(camera->elevation) < 90 && camera->distance > 0);
    const glm::mat4 matrix = camera->matrix();
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            REQUIRE(std::isfinite(matrix[i][k]));
}

void check_size(std::string_view text) {
    const auto size = host::parse_size(text);
    REQUIRE(!taken(size) || (size->width >= 1 && size->height >= 1));
}

void check_output(std::string_view text) {
    const auto name = host::OutputName::parse(text, 2);
    if (taken(name) && !name->standard_output() && !name->video())
        REQUIRE(name->of_frame(1).path() != name->of_frame(2).path());
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr void (*k_checks[])(std::string_view) = {check_frames, check_date, check_mouse,
                                                      check_camera, check_size, check_output};
    if (size > 0)
        k_checks[data[0] % std::size(k_checks)](text_of(data + 1, size - 1));
    return 0;
}
