#include "web/audience.hpp"
#include "web/messages.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <latch>

namespace tidemark::web::audience_test {

using testing::ElementsAre;
using testing::IsEmpty;

struct AudienceTest : testing::Test {
    Inbox inbox;
    std::map<ViewerId, std::vector<std::string>> sent;
    Audience audience = made(false);

    Audience made(bool once) {
        return Audience(
            {.send = [this](ViewerId viewer,
                            const SharedMessage& message) { sent[viewer].push_back(message->bytes); },
             .once = once},
            inbox);
    }
    void show(uint32_t number) {
        audience.show({number, std::make_shared<Message>(Message{fmt::format("picture {}", number), true})});
    }
    void seen(ViewerId viewer, uint32_t number) {
        EXPECT_TRUE(audience.said(viewer, fmt::format(R"({{"do":"seen","number":{}}})", number)));
    }
    std::vector<std::string> pictures(ViewerId viewer) {
        std::vector<std::string> found;
        for (const std::string& message : sent[viewer])
            if (message.starts_with("picture"))
                found.push_back(message);
        return found;
    }
    std::vector<host::InputEvent> events() { return inbox.wait(0).events; }
};

constexpr std::string_view k_press = R"({"do":"press","button":"left","x":1,"y":2})";

TEST_F(AudienceTest, a_slow_viewer_skips_pictures_and_delays_no_other) {
    audience.came(1);
    audience.came(2);
    for (uint32_t number = 1; number <= 5; ++number) {
        show(number);
        seen(2, number);
    }
    EXPECT_THAT(pictures(1), ElementsAre("picture 1", "picture 2"));
    EXPECT_THAT(pictures(2), ElementsAre("picture 1", "picture 2", "picture 3", "picture 4", "picture 5"));
    seen(1, 1);
    EXPECT_THAT(pictures(1), ElementsAre("picture 1", "picture 2", "picture 5"));
    seen(1, 5);
    EXPECT_THAT(pictures(1), testing::SizeIs(3)) << "there is no newer one";
}

TEST_F(AudienceTest, an_acknowledgement_of_an_unsent_picture_is_ignored) {
    audience.came(1);
    for (uint32_t number = 1; number <= 5; ++number) {
        show(number);
        seen(1, 2147483647);
    }
    EXPECT_THAT(pictures(1), ElementsAre("picture 1", "picture 2"));
    seen(1, 2);
    EXPECT_THAT(pictures(1).back(), "picture 5");
}

TEST_F(AudienceTest, rapid_changes_of_control_do_not_flood_viewers) {
    for (ViewerId viewer = 1; viewer <= 3; ++viewer)
        audience.came(viewer);
    sent.clear();
    for (int i = 0; i < 10000; ++i)
        EXPECT_TRUE(audience.said(ViewerId(1 + i % 2), R"({"do":"steer"})"));
    EXPECT_THAT(sent[3].size(), testing::AllOf(testing::Ge(1u), testing::Lt(256u)))
        << "what a connection holds";
}

TEST_F(AudienceTest, waits_while_a_viewer_is_ready) {
    EXPECT_FALSE(audience.is_waiting());
    audience.came(1);
    EXPECT_TRUE(audience.is_waiting());
    show(1);
    EXPECT_TRUE(audience.is_waiting());
    show(2);
    EXPECT_FALSE(audience.is_waiting());
    seen(1, 2);
    EXPECT_TRUE(audience.is_waiting());
}

TEST_F(AudienceTest, new_viewers_receive_the_current_state) {
    audience.tell("title", std::make_shared<Message>(Message{"old"}));
    audience.tell("title", std::make_shared<Message>(Message{"new"}));
    show(1);
    audience.came(1);
    EXPECT_THAT(sent[1], ElementsAre("new", "picture 1", R"({"steering":{"you":true,"viewers":1}})"));
}

TEST_F(AudienceTest, the_first_viewer_has_control) {
    audience.came(1);
    audience.came(2);
    EXPECT_EQ(sent[2].back(), R"({"steering":{"you":false,"viewers":2}})");
    ASSERT_TRUE(audience.said(2, k_press));
    EXPECT_THAT(events(), IsEmpty());
    ASSERT_TRUE(audience.said(1, k_press));
    EXPECT_THAT(events(), ElementsAre(host::ButtonPressed{host::Button::left, {1, 2}}));
}

TEST_F(AudienceTest, loss_of_control_releases_held_input) {
    audience.came(1);
    audience.came(2);
    ASSERT_TRUE(audience.said(1, k_press));
    ASSERT_TRUE(audience.said(1, R"({"do":"keydown","code":65})"));
    ASSERT_TRUE(audience.said(1, R"({"do":"move","x":5,"y":6})"));
    events();
    audience.left(1);
    EXPECT_THAT(events(), ElementsAre(host::ButtonReleased{host::Button::left, {5, 6}},
                                      host::KeyReleased{host::Key::a}));
    EXPECT_EQ(sent[2].back(), R"({"steering":{"you":true,"viewers":1}})");
    ASSERT_TRUE(audience.said(2, k_press));
    EXPECT_THAT(events(), testing::SizeIs(1));
}

TEST_F(AudienceTest, any_viewer_may_take_control) {
    audience.came(1);
    audience.came(2);
    ASSERT_TRUE(audience.said(1, k_press));
    events();
    ASSERT_TRUE(audience.said(2, R"({"do":"steer"})"));
    EXPECT_THAT(events(), testing::SizeIs(1)) << "the first one's button goes up";
    EXPECT_EQ(sent[1].back(), R"({"steering":{"you":false,"viewers":2}})");
}

TEST_F(AudienceTest, limits_the_number_of_viewers) {
    for (ViewerId viewer = 1; viewer <= Audience::k_most_viewers; ++viewer)
        EXPECT_TRUE(audience.came(viewer));
    EXPECT_FALSE(audience.came(100));
    audience.left(1);
    EXPECT_TRUE(audience.came(101));
}

TEST_F(AudienceTest, ends_with_its_last_viewer_if_configured) {
    Audience once = made(true);
    once.came(1);
    once.came(2);
    once.left(1);
    EXPECT_THAT(events(), IsEmpty());
    once.left(2);
    EXPECT_THAT(events(), ElementsAre(host::CloseRequested{}));
}

TEST_F(AudienceTest, a_flood_is_refused) {
    audience.came(1);
    Result<void> taken;
    int count = 0;
    while ((taken = audience.said(1, R"({"do":"pause"})")) && count < 100000)
        ++count;
    EXPECT_EQ(count, 4096) << "and no more";
    EXPECT_EQ(taken.error().message, "too many messages at a time");
}

TEST_F(AudienceTest, successive_pointer_moves_are_merged) {
    audience.came(1);
    for (int x = 0; x < 10000; ++x)
        ASSERT_TRUE(audience.said(1, fmt::format(R"({{"do":"move","x":{},"y":0}})", x)));
    EXPECT_THAT(events(), ElementsAre(host::PointerMoved{{9999, 0}}));
}

TEST(PictureEncoder, encodes_the_newest_picture) {
    std::latch begun(1), go_on(1), done(2);
    std::vector<uint32_t> numbers;
    PictureEncoder encoder({.encode =
                                [&, first = true](const image::Image&) mutable {
                                    if (std::exchange(first, false)) {
                                        begun.count_down();
                                        go_on.wait();
                                    }
                                    return std::string("file");
                                },
                            .done =
                                [&](const NumberedPicture& picture) {
                                    numbers.push_back(picture.number);
                                    EXPECT_TRUE(picture.message->bytes.ends_with("}file"));
                                    done.count_down();
                                }});
    encoder.push({{}, {.number = 1}});
    begun.wait();
    EXPECT_TRUE(encoder.has_room());
    encoder.push({{}, {.number = 2}});
    EXPECT_FALSE(encoder.has_room());
    encoder.push({{}, {.number = 3}});
    go_on.count_down();
    done.wait();
    EXPECT_THAT(numbers, ElementsAre(1, 3));
}

TEST(StateText, a_picture_has_a_header) {
    const auto message = picture_message(
        {.number = 3, .seconds = 2.5, .frame = 150, .costs = {1.234, {}}, .draw_ms = 4, .encode_ms = 0.5},
        "file");
    const std::string head =
        R"({"number":3,"seconds":2.5,"frame":150,"costs":[1.23,null],"draw":4.0,"encode":0.5})";
    EXPECT_EQ(message->bytes, std::string({char(head.size()), 0, 0, 0}) + head + "file");
    EXPECT_TRUE(message->binary);
}

TEST(StateText, contains_the_models_fields) {
    overlay::Model model;
    scene::Knob knob{.name = "height", .initial = {0.5}, .range = scene::KnobRange{{0}, {1}}};
    model.knobs.push_back({knob, {0.25}});
    model.definitions.push_back({.name = "STEPS", .value = 12, .whole = true});
    model.pictures.push_back({"Image", 0, {}});
    model.errors.push_back({{{"a.glsl", 3, 5}, Severity::error, "no"}, "int x = y;"});
    model.lenses = {.choices = {{"cost", "operations"}}, .chosen = 0};
    model.lens = {.title = "work",
                  .basis = "counted",
                  .bar = {{{0, 32, 77}, {255, 234, 70}}},
                  .low = "0",
                  .high = "9",
                  .mark = 0.5,
                  .pointer = "4",
                  .entries = {{.words = "min 1"}}};
    EXPECT_EQ(
        state_text(model, {64, 36}, {.keyboard = true, .every_move = true, .camera = true}),
        R"({"state":{"size":[64,36],"keyboard":true,"everyMove":true,"camera":true,"knobs":[{"name":"height",)"
        R"("colour":false,"whole":false,"value":[0.25],"low":[0.0],"high":[1.0],"turned":true}],"definitions":[{"name":"STEPS","value":"12",)"
        R"("whole":true,"held":false}],"pictures":["Image"],"large":null,"time":{"paused":false,"speed":1.0,)"
        R"("turnsBack":false,"hasSpeed":true,"from":null,"to":null},"lenses":{"choices":[{"name":"cost",)"
        R"("says":"operations","refusal":"","takesLine":false,"needsLine":false,"second":""}],)"
        R"("chosen":0,"place":"","variable":""},"lens":{"title":"work",)"
        R"("basis":"counted","bar":["#00204d","#ffea46"],"low":"0","high":"9","mark":0.5,"pointer":"4",)"
        R"("entries":[{"box":null,"words":"min 1"}],"refusal":"","progress":""},"errors":[{"text":"a.glsl:3:5: error: no",)"
        R"("line":"int x = y;","mark":"    ^"}]}})");
}

} // namespace tidemark::web::audience_test
