#include "render/frame_state.hpp"

#include "base/encoding.hpp"
#include "render/pass_state.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>

namespace tidemark::render {
namespace {

constexpr int k_row = 256;

bool is_code(int code) {
    return code >= 0 && code < k_row;
}

constexpr double k_highest = 89.9;
constexpr double k_nearest = 1e-3;
constexpr double k_farthest = 1e6;
constexpr double k_zoom_a_notch = 0.9;

glm::dmat4 camera_to_world(const OrbitCamera& camera) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), camera.target);
    matrix = glm::rotate(matrix, glm::radians(camera.azimuth), glm::dvec3(0, 1, 0));
    matrix = glm::rotate(matrix, glm::radians(-camera.elevation), glm::dvec3(1, 0, 0));
    return glm::translate(matrix, glm::dvec3(0, 0, camera.distance));
}

double wrapped(double degrees) {
    const double turned = std::fmod(degrees, 360.0);
    const double positive = turned < 0 ? turned + 360 : turned;
    return positive < 360 ? positive : 0; // a tiny negative angle rounds to 360
}

/// Consumes a number of at least 0 and then `separator`, unless that is 0.
template <class T>
bool take_number(std::string_view& text, T& number, char separator) {
    return consume_number(text, number) && number >= 0 && (separator == 0 || consume(text, separator));
}

bool take_time_of_day(std::string_view& text, double& seconds) {
    int hour = 0;
    int minute = 0;
    double second = 0;
    if (!take_number(text, hour, ':') || !take_number(text, minute, ':') || !take_number(text, second, 0))
        return false;
    seconds = hour * 3600.0 + minute * 60.0 + second;
    return hour < 24 && minute < 60 && second < 61;
}

UniformNumbers resolutions_of(const ChannelFacts& channels) {
    UniformNumbers numbers{};
    for (const ChannelFact& channel : channels)
        numbers.append(channel.resolution.begin(), channel.resolution.end());
    return numbers;
}

UniformNumbers times_of(const ChannelFacts& channels) {
    UniformNumbers numbers{};
    for (const ChannelFact& channel : channels)
        numbers.append(&channel.time, &channel.time + 1);
    return numbers;
}

UniformNumbers elements_of(const glm::mat4& matrix) {
    UniformNumbers numbers{};
    numbers.append(&matrix[0][0], &matrix[0][0] + 16);
    return numbers;
}

} // namespace

void Keyboard::press(int code) {
    if (!is_code(code) || texels_[size_t(code)] != 0)
        return;
    texels_[size_t(code)] = 255;
    texels_[size_t(k_row + code)] = 255;
    uint8_t& toggle = texels_[size_t(2 * k_row + code)];
    toggle = uint8_t(255 - toggle);
}

void Keyboard::release(int code) {
    if (!is_code(code) || texels_[size_t(code)] == 0)
        return;
    texels_[size_t(3 * k_row + code)] = 255;
    texels_[size_t(code)] = 0;
    texels_[size_t(k_row + code)] = 0;
}

void Keyboard::frame_drawn() {
    for (const int row : {1, 3})
        std::fill_n(texels_.begin() + row * k_row, k_row, uint8_t{0});
}

void Mouse::press(double x, double y) {
    down = true;
    is_new = true;
    move(x, y);
    pressed_at = position;
}

void Mouse::move(double x, double y) {
    if (down)
        position = {float(std::floor(x)) + 0.0f, float(std::floor(y)) + 0.0f}; // -0 + 0 is 0
}

glm::vec4 Mouse::uniform() const {
    // 0 - x rather than -x: a press at pixel 0 must not give a negative zero.
    return {position.x, position.y, down ? pressed_at.x : 0 - pressed_at.x,
            is_new ? pressed_at.y : 0 - pressed_at.y};
}

Mouse Mouse::clicked(glm::dvec2 at, bool now) {
    Mouse mouse;
    mouse.press(at.x, at.y);
    if (!now) {
        mouse.frame_drawn();
        mouse.release();
    }
    return mouse;
}

Mouse Mouse::dragged(glm::dvec2 from, glm::dvec2 to, bool held) {
    Mouse mouse;
    mouse.press(from.x, from.y);
    mouse.frame_drawn();
    mouse.move(to.x, to.y);
    if (!held)
        mouse.release();
    return mouse;
}

void Mouse::stretch(Extent from, Extent to) {
    const glm::vec2 scale{double(to.width) / from.width, double(to.height) / from.height};
    position = glm::floor(position * scale);
    pressed_at = glm::floor(pressed_at * scale);
}

void OrbitCamera::turn(double dx, double dy, double height) {
    azimuth = wrapped(azimuth - dx / height * 180);
    elevation = std::clamp(elevation - dy / height * 180, -k_highest, k_highest);
}

void OrbitCamera::zoom(double notches) {
    distance = std::clamp(distance * std::pow(k_zoom_a_notch, notches), k_nearest, k_farthest);
}

void OrbitCamera::pan(double dx, double dy, double height) {
    const glm::dmat4 frame = camera_to_world(*this);
    const double scale = distance / height;
    target -= (glm::dvec3(frame[0]) * dx + glm::dvec3(frame[1]) * dy) * scale;
}

glm::mat4 OrbitCamera::matrix() const {
    return glm::mat4(camera_to_world(*this));
}

OrbitMotion motion_of(const OrbitCamera& camera) {
    const OrbitCamera first;
    const glm::dvec2 degrees{std::remainder(camera.azimuth - first.azimuth, 360),
                             camera.elevation - first.elevation};
    const double heading = glm::radians(first.azimuth);
    const glm::dvec3 right{std::cos(heading), 0, -std::sin(heading)};
    const glm::dvec3 backwards{std::sin(heading), 0, std::cos(heading)};
    const glm::dvec3 moved = (camera.target - first.target) / first.distance;
    return {glm::radians(degrees),
            camera.distance / first.distance,
            {dot(moved, right), moved.y, dot(moved, backwards)}};
}

Result<OrbitCamera> parse_camera(std::string_view setting) {
    const std::vector<double> numbers = numbers_from<double>(setting);
    const auto fits = [](double number) { return std::abs(number) <= std::numeric_limits<float>::max(); };
    if ((numbers.size() != 3 && numbers.size() != 6) || !std::ranges::all_of(numbers, fits) ||
        numbers[2] < k_nearest || numbers[2] > k_farthest)
        return fail(ErrorCode::usage,
                    fmt::format("--camera {}: give azimuth,elevation,distance as in 30,20,10 (degrees, "
                                "degrees, a distance above 0), and after them x,y,z if the view was panned",
                                setting));
    OrbitCamera camera;
    camera.azimuth = wrapped(numbers[0]);
    camera.elevation = std::clamp(numbers[1], -k_highest, k_highest);
    camera.distance = numbers[2];
    if (numbers.size() == 6)
        camera.target = {numbers[3], numbers[4], numbers[5]};
    return camera;
}

Result<Date> parse_date(std::string_view iso) {
    Date date{0, 0, 0, 0};
    std::string_view rest = iso;
    bool good = take_number(rest, date.year, '-') && take_number(rest, date.month, '-') &&
                take_number(rest, date.day, 0);
    if (good && (consume(rest, 'T') || consume(rest, ' ')))
        good = take_time_of_day(rest, date.seconds);
    // std::chrono keeps a month in a byte: a month of 257 would look like January.
    good = good && date.year <= 9999 && date.month <= 12 && date.day <= 31;
    const std::chrono::year_month_day day{std::chrono::year(date.year),
                                          std::chrono::month(unsigned(date.month)),
                                          std::chrono::day(unsigned(date.day))};
    if (!good || !rest.empty() || !day.ok())
        return fail(ErrorCode::usage,
                    fmt::format("--date {}: give a date as in 2024-12-31 or 2024-12-31T23:59:58.5", iso));
    --date.month;
    return date;
}

Date local_date() {
    const auto now = std::chrono::system_clock::now();
    const std::time_t whole = std::chrono::system_clock::to_time_t(now);
    const auto since_epoch = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    std::tm local{};
    localtime_r(&whole, &local);
    return {local.tm_year + 1900, local.tm_mon, local.tm_mday,
            local.tm_hour * 3600 + local.tm_min * 60 + local.tm_sec +
                double(since_epoch.count() % 1000) / 1000};
}

Date later(const Date& date, double seconds) {
    using namespace std::chrono;
    constexpr double k_day = 86400;
    constexpr double k_most_days = 5e6; // years stay within the two bytes of std::chrono
    const double clock = date.seconds + seconds;
    const double days = std::clamp(std::floor(clock / k_day), -k_most_days, k_most_days);
    const year_month_day day{
        sys_days(year(date.year) / month(unsigned(date.month) + 1) / std::chrono::day(unsigned(date.day))) +
        std::chrono::days(long(days))};
    return {int(day.year()), int(unsigned(day.month())) - 1, int(unsigned(day.day())), clock - days * k_day};
}

int frame_at(double time, double fps) {
    return int(std::clamp(std::floor(time * fps), 0.0, double(k_last_frame)));
}

FrameInputs inputs_of_frame(int frame, double fps) {
    FrameInputs inputs;
    inputs.frame = frame;
    inputs.time = double(frame) / fps;
    inputs.time_delta = 1 / fps;
    inputs.frame_rate = fps;
    inputs.date = later(inputs.date, inputs.time);
    return inputs;
}

FrameState FrameState::at_frame(int number) const {
    FrameState other = *this;
    other.frame = number;
    if (time)
        other.time = *time - (frame - number) / fps;
    return other;
}

bool FrameState::is_in_run_of(const FrameState& other) const {
    FrameState here = other.at_frame(frame);
    const double gap = std::abs(here.seconds() - seconds());
    here.time = time;
    return here == *this && gap < 1e-6 / fps;
}

FrameState at_time(double seconds, FrameState state) {
    state.time = seconds;
    state.frame = frame_at(seconds, state.fps);
    return state;
}

FrameInputs inputs_of(const FrameState& state) {
    FrameInputs inputs;
    inputs.frame = state.frame;
    inputs.time = state.seconds();
    inputs.time_delta = state.time_delta.value_or(1 / state.fps);
    inputs.frame_rate = state.fps;
    inputs.bpm = state.bpm;
    inputs.mouse = state.mouse.uniform();
    inputs.mouse_button = {state.mouse.down ? 1 : 0, state.right_button ? 1 : 0};
    inputs.keyboard = state.keys;
    inputs.date = later(state.date, inputs.time);
    inputs.camera = state.camera.matrix();
    const OrbitMotion motion = motion_of(state.camera);
    inputs.orbit = {motion.turn, motion.distance, state.moves_camera() ? 1 : 0};
    inputs.orbit_pan = motion.pan;
    inputs.knobs = state.knobs;
    if (state.initial_camera)
        inputs.view = inverse(state.initial_camera->matrix()) * inputs.camera;
    return inputs;
}

UniformNumbers value_of(scene::HostValue value, const FrameInputs& inputs, Extent resolution,
                        const ChannelFacts& channels) {
    using scene::HostValue;
    switch (value) {
    case HostValue::resolution: return {double(resolution.width), double(resolution.height), 1};
    case HostValue::time: return {inputs.time};
    case HostValue::time_delta: return {inputs.time_delta};
    case HostValue::frame_rate: return {inputs.frame_rate};
    case HostValue::frame: return {double(inputs.frame)};
    case HostValue::mouse: return {inputs.mouse.x, inputs.mouse.y, inputs.mouse.z, inputs.mouse.w};
    case HostValue::date:
        return {double(inputs.date.year), double(inputs.date.month), double(inputs.date.day),
                inputs.date.seconds};
    case HostValue::sample_rate: return {k_sample_rate};
    case HostValue::channel_time: return times_of(channels);
    case HostValue::channel_resolution: return resolutions_of(channels);
    case HostValue::time_offset:
    case HostValue::sample_offset: return {0}; // set by SoundRenderer for each block
    case HostValue::camera: return elements_of(inputs.camera);
    case HostValue::orbit: return {inputs.orbit.x, inputs.orbit.y, inputs.orbit.z, inputs.orbit.w};
    case HostValue::orbit_pan: return {inputs.orbit_pan.x, inputs.orbit_pan.y, inputs.orbit_pan.z};
    case HostValue::time_low: return {inputs.time - double(float(inputs.time))};
    case HostValue::beat: return {inputs.time * inputs.bpm / 60};
    case HostValue::mouse_button: return {inputs.mouse_button.x, inputs.mouse_button.y, 0, 0};
    case HostValue::view: return elements_of(inputs.view);
    case HostValue::relative_mouse:
        return {inputs.mouse.x / std::max(1.0, double(resolution.width)),
                inputs.mouse.y / std::max(1.0, double(resolution.height))};
    }
    return {0};
}

} // namespace tidemark::render
