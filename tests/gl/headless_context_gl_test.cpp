// Makes its own contexts, so nothing here may share a process with a test that holds one.
#include "host/gl_context.hpp"
#include "lab/device_check.hpp"
#include "render/gl_context.hpp"
#include "render/gl_sync.hpp"
#include "render/gl_textures.hpp"

#include <EGL/egl.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace {
int displays_started = 0;
}

/// Takes the place of the library's function.
extern "C" EGLBoolean eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor) {
    static const auto initialize =
        reinterpret_cast<EGLBoolean (*)(EGLDisplay, EGLint*, EGLint*)>(::dlsym(RTLD_NEXT, "eglInitialize"));
    ++displays_started;
    return initialize(display, major, minor);
}

namespace tidemark::host::headless_context_gl_test {

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

std::vector<HeadlessDevice> every_device() {
    std::vector<HeadlessDevice> devices;
    list_headless_devices(
        [&](const HeadlessDevice& device, bool tried) {
            if (tried)
                devices.push_back(device);
        },
        0);
    return devices;
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

TEST(HeadlessContext, debug_context_has_the_debug_flag) {
    const auto context = HeadlessContext::create({"auto"}, DebugContext::yes);
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_NE(integer(GL_CONTEXT_FLAGS) & GL_CONTEXT_FLAG_DEBUG_BIT, 0);
}

TEST(HeadlessContext, draws_on_every_device_of_the_list) {
    int drawn = 0;
    for (const HeadlessDevice& device : every_device()) {
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

TEST(HeadlessContext, list_has_every_name_and_marks_llvmpipe_as_software) {
    const std::vector<HeadlessDevice> devices = every_device();
    ASSERT_GE(devices.size(), 2u);
    EXPECT_EQ(devices.front().name, "surfaceless");
    EXPECT_EQ(devices.back().name, "display");
    for (const HeadlessDevice& device : devices) {
        const bool is_llvmpipe = device.renderer.find("llvmpipe") != std::string::npos;
        EXPECT_TRUE(!is_llvmpipe || device.kind == DeviceKind::software) << device.name;
    }
}

TEST(HeadlessContext, list_keeps_the_current_context) {
    auto context = HeadlessContext::create();
    ASSERT_TRUE(context);
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    every_device();
    EXPECT_TRUE(glIsBuffer(buffer));
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
}

TEST(HeadlessContext, a_move_keeps_the_context_current) {
    auto made = HeadlessContext::create();
    ASSERT_TRUE(made);
    HeadlessContext first = std::move(*made);
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
    HeadlessContext second = std::move(first);
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(HeadlessContext, move_assignment_keeps_the_assigned_context) {
    auto first = HeadlessContext::create();
    auto second = HeadlessContext::create();
    ASSERT_TRUE(first && second);
    *first = std::move(*second);
    ASSERT_TRUE(first->make_current());
    EXPECT_EQ(cleared_pixel(k_colour), k_colour_bytes);
}

TEST(HeadlessContext, destruction_leaves_no_current_context) {
    ASSERT_TRUE(HeadlessContext::create());
    EXPECT_EQ(glGetString(GL_VERSION), nullptr);
}

TEST(HeadlessContext, two_contexts_alternate) {
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
    const std::string names = fmt::format("{}", fmt::join(device_names(), ", "));
    for (const char* unknown : {"gpu", "device:99", "device:", "", "Auto"}) {
        const auto context = HeadlessContext::create({unknown});
        ASSERT_FALSE(context) << unknown;
        EXPECT_EQ(context.error().code, ErrorCode::usage);
        EXPECT_EQ(context.error().message, fmt::format("unknown device '{}'; there are {}", unknown, names));
    }
}

TEST(HeadlessContext, the_names_are_those_of_all_devices_and_start_no_driver) {
    std::vector<std::string> names{"auto"};
    for (const HeadlessDevice& device : every_device()) {
        names.push_back(device.name);
        std::ranges::copy(device.lasting_names, std::back_inserter(names));
    }
    std::ranges::copy(mesa_drivers(), std::back_inserter(names));
    const int before = displays_started;
    EXPECT_EQ(device_names(), names);
    EXPECT_EQ(displays_started, before);
    EXPECT_GT(before, 0);
}

TEST(HeadlessContext, a_software_driver_is_not_a_gpu) {
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

TEST_F(HeadlessContextDeathTest, without_a_driver_the_error_lists_the_attempts) {
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

TEST_F(HeadlessContextDeathTest, without_a_display_only_the_error_is_printed) {
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

TEST_F(HeadlessContextDeathTest, a_driver_that_is_too_old_is_not_missing) {
    const auto with_old_driver = [](const char* device) {
        setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
        report_and_exit(device);
    };
    for (const char* device : {"surfaceless", "mesa:llvmpipe"})
        EXPECT_EXIT(with_old_driver(device), testing::ExitedWithCode(77),
                    testing::AllOf(testing::HasSubstr("the driver has no OpenGL 4.5 core (EGL_BAD_"),
                                   testing::HasSubstr(", only OpenGL 3.3"),
                                   testing::EndsWith(". `tidemark inspect --devices` lists what there is")))
            << device;
}

TEST_F(HeadlessContextDeathTest, auto_needs_no_display) {
    const auto without_display = [] {
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
        report_and_exit("auto");
    };
    EXPECT_EXIT(without_display(), testing::ExitedWithCode(0), testing::Eq(""));
}

/// Returns RGBA floats 0, 1, 2, … of so many pixels.
std::vector<float> counted(size_t pixels) {
    std::vector<float> values(4 * pixels);
    std::iota(values.begin(), values.end(), 0.0F);
    return values;
}

std::span<const std::byte> bytes_in(const std::vector<float>& values) {
    return std::as_bytes(std::span(values));
}

TEST(OpenglEs, is_there_on_request) {
    auto context = HeadlessContext::create({"es:auto"});
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_TRUE(gl::is_es());
    EXPECT_TRUE(gl::query_capabilities().device().ends_with(" with OpenGL ES"));
    auto shared = context->create_context();
    ASSERT_TRUE(shared) << shared.error().message;
    ASSERT_TRUE(shared->make_current());
    EXPECT_TRUE(gl::is_es());
}

TEST(OpenglEs, has_neither_a_timer_nor_mapped_buffers) {
    const auto context = HeadlessContext::create({"es:auto"});
    ASSERT_TRUE(context) << context.error().message;
    gl::ElapsedTime timer;
    timer.stop();
    EXPECT_EQ(timer.milliseconds(), std::nullopt);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)); // nothing was called that OpenGL ES lacks
    const auto target = gl::make_render_target(gl::make_texture({3, 2}, GL_RGBA8, 1));
    ASSERT_TRUE(target);
    gl::PixelRing ring(2);
    EXPECT_FALSE(ring.read(*target, {3, 2}, GL_RGBA, GL_UNSIGNED_BYTE, 24));
    EXPECT_TRUE(ring.empty());
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(OpenglEs, targets_keep_floats_and_are_read_as_bytes) {
    const auto context = HeadlessContext::create({"es:auto"});
    ASSERT_TRUE(context) << context.error().message;
    const auto target = gl::make_render_target(gl::make_texture({3, 2}, GL_RGBA32F, 1));
    ASSERT_TRUE(target);
    std::vector<float> values(4 * 6, 1.0F);
    gl::read_pixels(*target, GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(values)));
    EXPECT_THAT(values, testing::Each(0.0F)); // cleared
    std::vector<float> given = counted(6);
    given[1] = 0.5F;
    given[2] = -3;
    given[3] = std::numeric_limits<float>::quiet_NaN();
    gl::upload(target->texture, 0, GL_RGBA, GL_FLOAT, bytes_in(given));
    EXPECT_EQ(gl::read_part(target->texture, 0, {1, 1, {2, 1}}),
              std::vector<float>(given.begin() + 16, given.end()));
    std::vector<uint8_t> bytes(4 * 6);
    gl::read_pixels(*target, GL_RGBA, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(bytes)));
    EXPECT_THAT(std::span(bytes).first(8), testing::ElementsAre(0, 128, 0, 0, 255, 255, 255, 255));
    const auto copy = gl::make_render_target(gl::make_texture({2, 2}, GL_RGBA32F, 1));
    ASSERT_TRUE(copy);
    gl::copy_overlap(*target, *copy);
    EXPECT_THAT(gl::read_part(copy->texture, 0, {0, 1, {2, 1}}),
                testing::ElementsAre(12, 13, 14, 15, 16, 17, 18, 19));
    gl::clear(*copy);
    EXPECT_THAT(gl::read_level(copy->texture, 0), testing::Each(0.0F));
    EXPECT_EQ(gl::bytes_of(copy->texture), 2 * 2 * 16);
}

TEST(OpenglEs, textures_of_bytes_are_read_as_floats) {
    const auto context = HeadlessContext::create({"es:auto"});
    ASSERT_TRUE(context) << context.error().message;
    const std::array<uint8_t, 16> bytes{0, 51, 255, 255, 0, 51, 255, 255, 0, 51, 255, 255, 0, 51, 255, 255};
    for (const bool cube : {false, true}) {
        const gl::Texture texture =
            cube ? gl::make_cube_texture(2, GL_RGBA8, 0) : gl::make_texture({2, 2}, GL_RGBA8, 0);
        EXPECT_TRUE(gl::has_storage(texture));
        for (int face = 0; face < (cube ? 6 : 1); ++face)
            gl::upload(texture, face, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(bytes)));
        gl::make_mipmaps(texture);
        const std::vector<float> top = gl::read_level(texture, 1);
        ASSERT_EQ(top.size(), cube ? 24 : 4);
        EXPECT_THAT(std::vector(top.end() - 4, top.end()), testing::ElementsAre(0, 51.0F / 255, 1, 1));
    }
    const gl::Texture volume = gl::make_volume_texture({1, 1}, 3, GL_RGBA8, 1);
    for (int slice = 0; slice < 3; ++slice) {
        const std::array<uint8_t, 4> texel{uint8_t(slice * 51), 0, 0, 255};
        gl::upload(volume, slice, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texel)));
    }
    EXPECT_THAT(gl::read_part(volume, 2, {0, 0, {1, 1}}), testing::ElementsAre(0.4F, 0, 0, 1));
}

TEST(OpenglEs, conformance_scenes_have_the_pixels_of_the_convention) {
    const auto context = HeadlessContext::create({"es:auto"});
    ASSERT_TRUE(context) << context.error().message;
    const auto projects =
        lab::conformance_projects(std::filesystem::path(TIDEMARK_SOURCE_DIR) / "tests/cases/conformance");
    EXPECT_GT(projects.size(), 40U);
    for (const std::filesystem::path& project : projects) {
        SCOPED_TRACE(project.filename());
        const auto drawn = lab::conforms(project);
        EXPECT_TRUE(drawn) << to_string(drawn.error());
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)); // no call that OpenGL ES lacks
    }
}

} // namespace tidemark::host::headless_context_gl_test
