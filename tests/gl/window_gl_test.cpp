// A real window on the display of the environment (Xvfb will do), driven from outside with xdotool.
#ifdef TIDEMARK_WINDOW
#include "window/window.hpp"

#include <GL/gl.h>
#include <GL/glext.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <optional>
#include <thread>

namespace tidemark::window {

using namespace host;

void PrintTo(const InputEvent& event, std::ostream* out) {
    *out << "event of kind " << event.index();
    if (const auto* moved = std::get_if<PointerMoved>(&event))
        *out << " moved to " << moved->at.x << ',' << moved->at.y;
    if (const auto* pressed = std::get_if<KeyPressed>(&event))
        *out << " key " << js_key_code(pressed->key);
    if (const auto* resized = std::get_if<FramebufferResized>(&event))
        *out << ' ' << resized->extent.width << 'x' << resized->extent.height;
}

namespace window_gl_test {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Events = std::vector<InputEvent>;
using testing::Contains;
using testing::IsEmpty;
using testing::StartsWith;

/// Sets a variable of the environment (or unsets it) for as long as it lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name))
            before_ = before;
        put(value);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() { put(before_ ? before_->c_str() : nullptr); }

private:
    void put(const char* value) const { value ? setenv(name_, value, 1) : unsetenv(name_); }
    const char* name_;
    std::optional<std::string> before_;
};

TEST(WindowWithoutDisplay, names_the_display_and_capture) {
    const Variable no_x("DISPLAY", nullptr);
    const Variable no_wayland("WAYLAND_DISPLAY", nullptr);
    const auto window = Window::create({64, 64}, "t");
    ASSERT_FALSE(window);
    EXPECT_EQ(window.error().code, ErrorCode::no_context);
    EXPECT_EQ(window.error().message,
              "cannot open a window: there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set); "
              "`tidemark capture` draws without one");
}

TEST(WindowWithoutDisplay, reports_the_window_systems_error) {
    const Variable nowhere("DISPLAY", ":4711");
    const Variable no_wayland("WAYLAND_DISPLAY", nullptr);
    for (int turn = 0; turn < 2; ++turn) {
        const auto window = Window::create({64, 64}, "t");
        ASSERT_FALSE(window);
        EXPECT_EQ(window.error().code, ErrorCode::no_context);
        // GLFW 3.3 names the display, 3.4 tries every platform first.
        EXPECT_THAT(window.error().message,
                    testing::AnyOf("cannot open a window: X11: Failed to open display :4711; "
                                   "`tidemark capture` draws without one",
                                   "cannot open a window: Failed to detect any supported platform; "
                                   "`tidemark capture` draws without one"));
    }
}

bool succeeds(const std::string& command) {
    return std::system(command.c_str()) == 0;
}

std::string output_of(const std::string& command) {
    std::string output;
    if (FILE* pipe = popen(command.c_str(), "r")) {
        char block[256];
        while (const size_t count = std::fread(block, 1, sizeof block, pipe))
            output.append(block, count);
        pclose(pipe);
    }
    return output;
}

class WindowTest : public testing::Test {
protected:
    static constexpr Extent k_extent{320, 180};

    void SetUp() override {
        if (!std::getenv("DISPLAY"))
            GTEST_SKIP() << "there is no DISPLAY: run it under xvfb-run";
        title_ = fmt::format("tidemark-test-{}", ::getpid());
        open();
        if (HasFatalFailure()) // xdotool would wait for it for ever
            return;
        if (!succeeds(fmt::format("xdotool search --sync --name '^{}$' windowmove 40 30", title_)))
            GTEST_SKIP() << "xdotool is not installed";
        gather([](const Events& events) { return !events.empty(); }, 100ms);
    }
    void open() {
        auto opened = Window::create(k_extent, title_);
        ASSERT_TRUE(opened) << opened.error().message;
        window_.emplace(std::move(*opened));
        window_->swap();
    }
    /// Does something to the window: `{}` in an xdotool command line stands for its number.
    void act(const std::string& command) {
        const std::string number = "$(xdotool search --name '^" + title_ + "$')";
        std::string line = "xdotool " + command;
        for (size_t at = 0; (at = line.find("{}", at)) != std::string::npos; at += number.size())
            line.replace(at, 2, number);
        ASSERT_TRUE(succeeds(line)) << line;
    }
    /// All events until `enough` of them have come, or time is up.
    template <class Enough>
    Events gather(Enough enough, std::chrono::milliseconds limit = 3s) {
        Events all;
        const auto end = Clock::now() + limit;
        while (!enough(all) && Clock::now() < end)
            for (const InputEvent& event : window_->wait(0.02))
                all.push_back(event);
        return all;
    }
    Events gather_until(const InputEvent& last) {
        return gather([&](const Events& events) { return std::ranges::find(events, last) != events.end(); });
    }
    /// Those that opening a window brings along.
    void let_events_pass() {
        gather([](const Events&) { return false; }, 200ms);
    }
    template <class Event>
    static std::vector<Event> only(const Events& events) {
        std::vector<Event> chosen;
        for (const InputEvent& event : events)
            if (const auto* one = std::get_if<Event>(&event))
                chosen.push_back(*one);
        return chosen;
    }

    std::string title_;
    std::optional<Window> window_;
};

using Pixel = std::array<unsigned char, 4>;

Pixel cleared_pixel() {
    glClearColor(0.2f, 0.4f, 0.6f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    Pixel pixel{};
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    return pixel;
}

constexpr Pixel k_pixel{51, 102, 153, 255};

GLint back_buffer(GLenum attachment, GLenum name) {
    GLint value = -1;
    glGetNamedFramebufferAttachmentParameteriv(0, attachment, name, &value);
    return value;
}

TEST_F(WindowTest, a_second_context_serves_a_thread_and_then_the_window) {
    auto context = window_->create_context();
    ASSERT_TRUE(context) << context.error().message;
    GLuint texture = 0;
    GLuint vertices = 0;
    std::thread([&] {
        EXPECT_TRUE(context->make_current());
        glCreateTextures(GL_TEXTURE_2D, 1, &texture);
        glCreateVertexArrays(1, &vertices);
        glFinish();
        context->leave();
    }).join();
    EXPECT_FALSE(glIsVertexArray(vertices)); // the window's first context is current
    EXPECT_TRUE(glIsTexture(texture));       // and shares textures
    {
        const KeepCurrent first;
        ASSERT_TRUE(context->make_current());
        EXPECT_TRUE(glIsVertexArray(vertices));
    }
    EXPECT_FALSE(glIsVertexArray(vertices));
    ASSERT_TRUE(context->make_current_in_window());
    EXPECT_TRUE(glIsVertexArray(vertices));
    EXPECT_TRUE(glIsTexture(texture));
    EXPECT_EQ(cleared_pixel(), k_pixel);
    window_->swap();
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_F(WindowTest, has_an_opengl_4_5_core_context_and_plain_colours_only) {
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_THAT(reinterpret_cast<const char*>(glGetString(GL_VERSION)), StartsWith("4."));
    EXPECT_EQ(window_->framebuffer_extent(), k_extent);
    EXPECT_EQ(cleared_pixel(), k_pixel);
    EXPECT_EQ(back_buffer(GL_BACK_LEFT, GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE), 8);
    // Mesa's buffers could encode; that nothing asks them to is what keeps the bytes.
    EXPECT_FALSE(glIsEnabled(GL_FRAMEBUFFER_SRGB));
    EXPECT_EQ(back_buffer(GL_DEPTH, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE), GL_NONE);
    EXPECT_EQ(back_buffer(GL_STENCIL, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE), GL_NONE);
}

TEST_F(WindowTest, resize_arrives_as_an_event) {
    act("windowsize {} 400 300");
    const FramebufferResized resized{{400, 300}};
    EXPECT_THAT(gather_until(resized), Contains(InputEvent(resized)));
    EXPECT_EQ(window_->framebuffer_extent(), resized.extent);
    act("mousemove --window {} 10 20");
    const PointerMoved moved{{10, 280}};
    EXPECT_THAT(gather_until(moved), Contains(InputEvent(moved))) << "from the new bottom";
}

TEST_F(WindowTest, drag_arrives_from_the_bottom_left) {
    act("mousemove --window {} 30 50 mousedown 1 mousemove --window {} 60 40 mouseup 1");
    const ButtonReleased released{Button::left, {60, 140}};
    const Events events = gather_until(released);
    EXPECT_EQ(only<ButtonPressed>(events), (std::vector<ButtonPressed>{{Button::left, {30, 130}}}));
    EXPECT_EQ(only<ButtonReleased>(events), std::vector<ButtonReleased>{released});
    EXPECT_THAT(only<PointerMoved>(events), Contains(PointerMoved{{30, 130}}));
    EXPECT_THAT(only<PointerMoved>(events), Contains(PointerMoved{{60, 140}}));
}

TEST_F(WindowTest, drag_continues_outside_the_window) {
    act("mousemove --window {} 5 5 mousedown 1 mousemove 0 0 mouseup 1");
    const ButtonReleased released{Button::left, {-40, 210}};
    EXPECT_THAT(gather_until(released), Contains(InputEvent(released)));
}

TEST_F(WindowTest, other_buttons_and_the_wheel) {
    act("mousemove --window {} 9 9 click 2 click 3 click 4 click 5 click 5 click 8");
    const Events events = gather([](const Events& all) { return only<WheelTurned>(all).size() == 3; });
    EXPECT_EQ(only<ButtonPressed>(events),
              (std::vector<ButtonPressed>{{Button::middle, {9, 171}}, {Button::right, {9, 171}}}));
    EXPECT_EQ(only<WheelTurned>(events), (std::vector<WheelTurned>{{0, 1}, {0, -1}, {0, -1}}));
}

TEST_F(WindowTest, keys_arrive_pressed_and_released) {
    act("windowfocus --sync {} key space Left Home s F Escape");
    const Events events = gather_until(KeyReleased{Key::escape});
    EXPECT_EQ(only<KeyPressed>(events),
              (std::vector<KeyPressed>{
                  {Key::space}, {Key::left}, {Key::home}, {Key::s}, {Key::shift}, {Key::f}, {Key::escape}}));
    EXPECT_EQ(only<KeyReleased>(events).size(), 7u);
}

TEST_F(WindowTest, lost_focus_releases_held_keys_and_buttons) {
    act("windowfocus --sync {} keydown d");
    const KeyPressed pressed{Key(68)};
    EXPECT_THAT(gather_until(pressed), Contains(InputEvent(pressed)));
    act("windowfocus $(xdotool search --maxdepth 0 --name '')");
    const KeyReleased released{Key(68)};
    EXPECT_THAT(gather_until(released),
                testing::AllOf(Contains(InputEvent(FocusLost{})), Contains(InputEvent(released))));
    act("keyup d");
}

TEST_F(WindowTest, title_changes) {
    window_->set_title(title_ + " wäre besser");
    EXPECT_EQ(output_of(fmt::format("xdotool search --sync --name '^{} ' getwindowname", title_)),
              title_ + " wäre besser\n");
}

TEST_F(WindowTest, requests_a_redraw_when_it_reappears) {
    let_events_pass();
    act("windowunmap --sync {} windowmap {}");
    EXPECT_THAT(gather_until(RedrawNeeded{}), Contains(InputEvent(RedrawNeeded{})));
}

TEST_F(WindowTest, full_screen_and_back) {
    window_->toggle_full_screen();
    const std::string screen = output_of("xdotool getdisplaygeometry");
    Extent extent;
    ASSERT_EQ(std::sscanf(screen.c_str(), "%d %d", &extent.width, &extent.height), 2);
    EXPECT_THAT(gather_until(FramebufferResized{extent}), Contains(InputEvent(FramebufferResized{extent})));
    window_->toggle_full_screen();
    EXPECT_THAT(gather_until(FramebufferResized{k_extent}),
                Contains(InputEvent(FramebufferResized{k_extent})));
    EXPECT_EQ(cleared_pixel(), k_pixel);
}

TEST_F(WindowTest, a_second_window_opens_only_after_the_first_closes) {
    const auto second = Window::create(k_extent, "second");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message, "cannot open a window: this process has one already; `tidemark "
                                      "capture` draws without one");
    EXPECT_EQ(cleared_pixel(), k_pixel) << "the first is unharmed";
    window_.reset();
    open();
    EXPECT_EQ(cleared_pixel(), k_pixel);
}

TEST_F(WindowTest, events_follow_a_move) {
    Window moved = std::move(*window_);
    window_.emplace(std::move(moved));
    act("windowsize {} 200 100");
    const FramebufferResized resized{{200, 100}};
    EXPECT_THAT(gather_until(resized), Contains(InputEvent(resized)));
    window_->make_current();
    EXPECT_EQ(cleared_pixel(), k_pixel);
}

TEST_F(WindowTest, another_thread_ends_a_wait) {
    let_events_pass();
    const auto start = Clock::now();
    std::thread waker([] {
        std::this_thread::sleep_for(50ms);
        Window::wake();
    });
    EXPECT_THAT(window_->wait(std::numeric_limits<double>::infinity()), IsEmpty());
    waker.join();
    EXPECT_GE(Clock::now() - start, 45ms);
    EXPECT_LT(Clock::now() - start, 2s);
}

TEST_F(WindowTest, wait_sleeps) {
    let_events_pass();
    const auto start = Clock::now();
    const std::clock_t before = std::clock();
    window_->wait(0.3);
    EXPECT_GE(Clock::now() - start, 290ms);
    EXPECT_LT(double(std::clock() - before) / CLOCKS_PER_SEC, 0.05);
}

} // namespace window_gl_test
} // namespace tidemark::window
#endif
