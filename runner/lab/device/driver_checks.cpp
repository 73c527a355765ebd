#include "base/software_renderer.hpp"
#include "base/try.hpp"
#include "gl/capabilities.hpp"
#include "gl/elapsed_time.hpp"
#include "gl/reset.hpp"
#include "lab/device/device_checks.hpp"
#include "lab/device/sample_drawing.hpp"
#include "lab/stopwatch.hpp"
#include "lab/study/timing.hpp"

#include <GL/gl.h>
#include <fmt/format.h>

namespace tidemark::lab {

Result<DeviceAnswer> ask_program_cache() {
    const auto renderer = TRY(renderer_of(
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, iTime, 1.0); }", {.extent = {8, 8}}));
    const gl::ProgramBinary binary = renderer.program(renderer.shown_index()).binary();
    if (binary.bytes.empty())
        return DeviceAnswer{Verdict::pass, "the driver writes no programs down: each is compiled anew"};
    if (!gl::Program::load(binary))
        return DeviceAnswer{Verdict::warn, "a program that the driver wrote down does not link again"};
    return DeviceAnswer{Verdict::pass, fmt::format("a program of {} bytes links again", binary.bytes.size())};
}

Result<DeviceAnswer> ask_timer() {
    ClockComparison clocks;
    for (const int turns : {200, 2000}) {
        auto renderer = TRY(
            renderer_of(fmt::format("void mainImage(out vec4 c, in vec2 p) {{"
                                    "  float s = p.x; for (int i = 0; i < {}; ++i) s = sin(s + p.y + iTime);"
                                    "  c = vec4(s);"
                                    "}}",
                                    turns),
                        {.extent = {640, 360}}));
        for (int frame = 0; frame < 6; ++frame) {
            glFinish();
            const Stopwatch watch;
            gl::ElapsedTime timer;
            renderer.draw({.time = double(frame)});
            timer.stop();
            glFinish();
            const auto told = timer.milliseconds();
            if (!told)
                return DeviceAnswer{Verdict::warn, "the driver has no timer: times are by the wall clock"};
            if (frame > 0) // the first frame includes compilation
                clocks.add(*told, watch.elapsed().wall);
        }
    }
    return DeviceAnswer{
        clocks.agree() ? Verdict::pass : Verdict::warn,
        fmt::format("the driver's timer is {:.2f} to {:.2f} times the wall clock around glFinish{}",
                    clocks.least, clocks.most, clocks.agree() ? "" : ": times are by the wall clock")};
}

Result<DeviceAnswer> ask_reset() {
    if (gl::tells_resets())
        return DeviceAnswer{Verdict::pass,
                            "the driver says when it was reset: what it drew is not taken for a picture"};
    if (is_software_renderer(gl::query_capabilities().renderer))
        return DeviceAnswer{Verdict::pass, "the processor draws: there is no driver to be reset"};
    return DeviceAnswer{
        Verdict::warn,
        "the driver does not say when it was reset: pictures drawn after that are not what they seem"};
}

} // namespace tidemark::lab
