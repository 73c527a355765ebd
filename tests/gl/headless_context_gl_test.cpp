// Makes its own contexts, so nothing here may share a process with a test that holds one.
#include "host/gl_context.hpp"

#include <GL/gl.h>
#include <GL/glext.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace tidemark::platform::headless_context_gl_test {

using Pixel = std::array<unsigned char, 4>;
using testing::IsEmpty;

/// Clears an RGBA8 target to `colour` with the current context and reads a pixel back.
Pixel cleared_pixel(const std::array<float, 4>& colour) {
    GLuint framebuffer = 0;
    GLuint colours = 0;
    glCreateFramebuffers(1, &framebuffer);
    glCreateRenderbuffers(1, &colours);
    glNamedRenderbufferStorage(colours, GL_RGBA8, 4, 4);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours);
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, colour.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    Pixel pixel{};
    glReadPixels(3, 3, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    glDeleteRenderbuffers(1, &colours);
    glDeleteFramebuffers(1, &framebuffer);
    return pixel;
}

constexpr std::array<float, 4> k_colour{1.0f, 0.2f, 0.4f, 0.6f};
constexpr Pixel k_colour_bytes{255, 51, 102, 153};

GLint integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

TEST(HeadlessContext, is_a_current_opengl_4_5_core_context) {
    const auto context = HeadlessContext::create();
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_GE(integer(GL_MAJOR_VERSION) * 10 + integer(GL_MINOR_VERSION), 45);
    EXPECT_EQ(integer(GL_CONTEXT_PROFILE_MASK), GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_EQ(integer(GL_CONTEXT_FLAGS) & GL_CONTEXT_FLAG_DEBUG_BIT, 0);
    EXPECT_NE(context->device(), "auto");
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
}

TEST(HeadlessContext, debug_context_says_so) {
    const auto context = HeadlessContext::create({"auto"}, DebugContext::yes);
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_NE(integer(GL_CONTEXT_FLAGS) & GL_CONTEXT_FLAG_DEBUG_BIT, 0);
}

TEST(HeadlessContext, draws_on_every_device_of_the_list) {
    int drawn = 0;
    for (const HeadlessDevice& device : list_headless_devices()) {
        SCOPED_TRACE(device.name);
        if (device.renderer.empty()) {
            EXPECT_THAT(device.reason, Not(IsEmpty()));
            continue;
        }
        const auto start = std::chrono::steady_clock::now();
        const auto context = HeadlessContext::create({device.name});
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        ASSERT_TRUE(context) << context.error().message;
        fmt::print("{}: {}, {} in {:.1f} ms\n", device.name, device.renderer, device.version, taken.count());
        EXPECT_EQ(context->device(), device.name);
        EXPECT_EQ(reinterpret_cast<const char*>(glGetString(GL_RENDERER)), device.renderer);
        EXPECT_EQ(reinterpret_cast<const char*>(glGetString(GL_VERSION)), device.version);
        EXPECT_THAT(device.reason, IsEmpty());
        EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
        ++drawn;
    }
    EXPECT_GT(drawn, 0);
}

TEST(HeadlessContext, list_has_every_name_and_knows_llvmpipe_for_software) {
    const std::vector<HeadlessDevice> devices = list_headless_devices();
    ASSERT_GE(devices.size(), 2u);
    EXPECT_EQ(devices.front().name, "surfaceless");
    EXPECT_EQ(devices.back().name, "display");
    for (const HeadlessDevice& device : devices) {
        const bool is_llvmpipe = device.renderer.find("llvmpipe") != std::string::npos;
        EXPECT_TRUE(!is_llvmpipe || device.kind == DeviceKind::software) << device.name;
    }
}

TEST(HeadlessContext, list_leaves_the_current_context_alone) {
    auto context = HeadlessContext::create();
    ASSERT_TRUE(context);
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    list_headless_devices();
    EXPECT_TRUE(glIsBuffer(buffer));
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
}

TEST(HeadlessContext, moves_with_what_is_current) {
    auto made = HeadlessContext::create();
    ASSERT_TRUE(made);
    HeadlessContext first = std::move(*made);
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
    HeadlessContext second = std::move(first);
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(HeadlessContext, one_that_is_replaced_does_not_take_the_other_along) {
    auto first = HeadlessContext::create();
    auto second = HeadlessContext::create();
    ASSERT_TRUE(first && second);
    *first = std::move(*second);
    ASSERT_TRUE(first->make_current());
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
}

TEST(HeadlessContext, is_not_current_any_more_when_it_is_gone) {
    ASSERT_TRUE(HeadlessContext::create());
    EXPECT_EQ(glGetString(GL_VERSION), nullptr);
}

TEST(HeadlessContext, two_take_turns) {
    auto first = HeadlessContext::create();
    ASSERT_TRUE(first);
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    auto second = HeadlessContext::create();
    ASSERT_TRUE(second);
    EXPECT_FALSE(glIsBuffer(buffer));
    ASSERT_TRUE(first->make_current());
    EXPECT_TRUE(glIsBuffer(buffer));
    second = fail(ErrorCode::check_failed, "put away");
    EXPECT_TRUE(glIsBuffer(buffer));
}

TEST(HeadlessContext, unknown_device_is_a_usage_error_with_the_list) {
    std::string names = "auto";
    for (const HeadlessDevice& device : list_headless_devices())
        names += ", " + device.name;
    for (const char* unknown : {"gpu", "device:99", "device:", "", "Auto"}) {
        const auto context = HeadlessContext::create({unknown});
        ASSERT_FALSE(context) << unknown;
        EXPECT_EQ(context.error().code, ErrorCode::usage);
        EXPECT_EQ(context.error().message, fmt::format("unknown device '{}'; there are {}", unknown, names));
    }
}

TEST(HeadlessContext, a_software_driver_is_no_gpu) {
    const auto any = HeadlessContext::create();
    if (!any)
        GTEST_SKIP() << any.error().message;
    const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    if (renderer.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << renderer;
    const auto context = HeadlessContext::create({any->device(), true});
    ASSERT_FALSE(context);
    EXPECT_EQ(context.error().code, ErrorCode::no_context);
    EXPECT_THAT(context.error().message, testing::StartsWith("no graphics card can draw: " + any->device() +
                                                             ": draws on the CPU (" + renderer + ")"));
}

/// Writes the error of `create(device)` to standard error and ends with its exit code.
[[noreturn]] void report_and_exit(const char* device) {
    const auto context = HeadlessContext::create({device});
    if (context)
        std::_Exit(0);
    std::fputs(context.error().message.c_str(), stderr);
    std::_Exit(exit_code(context.error().code));
}

// A death test in a process of its own: EGL looks for its drivers once in a process.
class HeadlessContextDeathTest : public testing::Test {
protected:
    HeadlessContextDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

    static constexpr const char* k_advice =
        ". Install a driver (Debian's libgl1-mesa-dri draws on the CPU; a graphics card needs its vendor's "
        "EGL driver); `tidemark inspect --devices` lists what there is";
};

TEST_F(HeadlessContextDeathTest, no_driver_is_no_context_and_says_what_was_tried) {
    const auto without_drivers = [](const char* device) {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
        report_and_exit(device);
    };
    EXPECT_EXIT(without_drivers("auto"), testing::ExitedWithCode(77),
                testing::Eq(std::string("no OpenGL 4.5 context without a window: surfaceless: no driver "
                                        "offers it (EGL_BAD_PARAMETER); display: no driver offers it "
                                        "(EGL_BAD_PARAMETER)") +
                            k_advice));
    EXPECT_EXIT(without_drivers("surfaceless"), testing::ExitedWithCode(77),
                testing::Eq(std::string("no OpenGL 4.5 context without a window: surfaceless: no driver "
                                        "offers it (EGL_BAD_PARAMETER)") +
                            k_advice));
}

TEST_F(HeadlessContextDeathTest, no_display_is_no_context_and_nothing_is_printed_beside_it) {
    const auto without_display = [] {
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
        report_and_exit("display");
    };
    EXPECT_EXIT(without_display(), testing::ExitedWithCode(77),
                testing::Eq(std::string("no OpenGL 4.5 context without a window: display: the driver does "
                                        "not start (EGL_NOT_INITIALIZED)") +
                            k_advice));
}

TEST_F(HeadlessContextDeathTest, auto_needs_no_display) {
    const auto without_display = [] {
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
        report_and_exit("auto");
    };
    EXPECT_EXIT(without_display(), testing::ExitedWithCode(0), testing::Eq(""));
}

} // namespace tidemark::platform::headless_context_gl_test
