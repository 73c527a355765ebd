#include "web/request.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tidemark::web::request_test {

using host::InputEvent;

/// Returns the message as a T; nothing if it is refused or of another type.
template <class T>
std::optional<T> read(std::string_view message) {
    const auto request = parse_request(message);
    if (!request)
        return std::nullopt;
    if constexpr (std::is_constructible_v<InputEvent, T>) {
        const auto* event = std::get_if<InputEvent>(&*request);
        const T* wanted = event ? std::get_if<T>(event) : nullptr;
        return wanted ? std::optional(*wanted) : std::nullopt;
    } else {
        const auto* command = std::get_if<overlay::Command>(&*request);
        const T* wanted = command ? std::get_if<T>(command) : nullptr;
        return wanted ? std::optional(*wanted) : std::nullopt;
    }
}

std::string refusal(std::string_view message) {
    const auto request = parse_request(message);
    return request ? "taken" : request.error().message;
}

TEST(Request, becomes_a_window_event) {
    using namespace host;
    EXPECT_EQ(read<ButtonPressed>(R"({"do":"press","button":"right","x":1.5,"y":-2})"),
              (ButtonPressed{Button::right, {1.5, -2}}));
    EXPECT_EQ(read<ButtonReleased>(R"({"do":"release","button":"left","x":1,"y":2})"),
              (ButtonReleased{Button::left, {1, 2}}));
    EXPECT_EQ(read<PointerMoved>(R"({"do":"move","x":3,"y":4})"), (PointerMoved{{3, 4}}));
    EXPECT_EQ(read<WheelTurned>(R"({"do":"wheel","up":-1})"), (WheelTurned{0, -1}));
    EXPECT_EQ(read<KeyPressed>(R"({"do":"keydown","code":65})"), (KeyPressed{Key::a}));
    EXPECT_EQ(read<KeyReleased>(R"({"do":"keyup","code":37})"), (KeyReleased{Key::left}));
}

TEST(Request, becomes_an_overlay_command) {
    const auto turn = read<overlay::TurnKnob>(R"({"do":"turn","name":"height","value":[1,2]})");
    ASSERT_TRUE(turn);
    EXPECT_EQ(turn->name, "height");
    EXPECT_EQ(turn->value, (scene::KnobValue{1, 2}));
    EXPECT_EQ(read<overlay::Define>(R"({"do":"define","name":"STEPS","value":"12"})")->value, "12");
    for (const char* verb : {"define", "undefine", "turn", "reset"})
        for (const char* name : {R"(A\n#error)", "A=1;", "", "9", R"(A\u0000)"})
            EXPECT_EQ(refusal(fmt::format(R"({{"do":"{}","name":"{}","value":"1"}})", verb, name)),
                      R"("name": give a name of letters, digits and _)")
                << verb << " " << name;
    EXPECT_EQ(read<overlay::ShowPicture>(R"({"do":"show","picture":2})")->index, 2u);
    EXPECT_FALSE(read<overlay::ShowPicture>(R"({"do":"show","picture":null})")->index);
    EXPECT_EQ(read<overlay::Seek>(R"({"do":"seek","seconds":2.5})")->seconds, 2.5);
    EXPECT_EQ(read<overlay::SetLoop>(R"({"do":"loop","from":1,"to":null})")->from, 1);
    EXPECT_TRUE(read<overlay::TogglePause>(R"({"do":"pause"})"));
    EXPECT_EQ(read<overlay::SetLens>(R"({"do":"lens","lens":"value:sea.glsl:12:p.x@max"})")->lens,
              "value:sea.glsl:12:p.x@max");
    EXPECT_EQ(read<overlay::SetLens>(R"({"do":"lens","lens":""})")->lens, "");
    EXPECT_EQ(refusal(R"({"do":"lens","lens":"value:3:a b"})"),
              R"("lens": give a lens such as cost or value:12:p, or an empty text)");
}

TEST(Request, refuses_requests_that_touch_files) {
    for (const std::string_view message : {R"({"do":"open editor","file":"/etc/passwd","line":1})",
                                           R"({"do":"write knobs"})", R"({"do":"save"})"})
        EXPECT_EQ(refusal(message), "\"do\": give a known request") << message;
}

TEST(Request, accepts_only_decimal_numbers_as_definitions) {
    for (const std::string_view value :
         {"1); discard; (", "1\\n#include </etc/passwd>", "", "0x10", "nan", "1.0f"})
        EXPECT_EQ(refusal(fmt::format(R"({{"do":"define","name":"A","value":"{}"}})", value)),
                  "\"value\": give a decimal number")
            << value;
}

TEST(Request, malformed_messages_are_refused) {
    for (const std::string_view message : {"",
                                           "{",
                                           "[]",
                                           "null",
                                           "1",
                                           "{}",
                                           R"({"do":1})",
                                           R"({"do":"press"})",
                                           R"({"do":"press","button":"left","x":1})",
                                           R"({"do":"press","button":"left","x":"1","y":2})",
                                           R"({"do":"press","button":"fourth","x":1,"y":2})",
                                           R"({"do":"press","button":"left","x":1e99,"y":2})",
                                           R"({"do":"move","x":null,"y":2})",
                                           R"({"do":"keydown","code":0})",
                                           R"({"do":"keydown","code":256})",
                                           R"({"do":"keydown","code":6.5})",
                                           R"({"do":"keydown","code":18446744073709551615})",
                                           R"({"do":"turn","name":"a","value":[]})",
                                           R"({"do":"turn","name":"a","value":[1,2,3,4,5]})",
                                           R"({"do":"turn","name":"a","value":["1"]})",
                                           R"({"do":"turn","value":[1]})",
                                           R"({"do":"show","picture":-1})",
                                           R"({"do":"seen","number":0})",
                                           R"({"do":"seen"})",
                                           "{\"do\":\"pause\"}\x80",
                                           "\xff\xfe"})
        EXPECT_NE(refusal(message), "taken") << message;
    EXPECT_EQ(refusal(std::string(3000, '[') + std::string(3000, ']')), "a message has at most 4096 bytes");
    EXPECT_EQ(refusal(std::string(4000, '[')), "a message must be a JSON object");
    EXPECT_NE(refusal(R"({"do":")" + std::string(1000, 'a') + R"("})"), "taken");
}

} // namespace tidemark::web::request_test
