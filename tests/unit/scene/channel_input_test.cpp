#include "scene/channel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace tidemark::scene::channel_input_test {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ChannelInput, each_kind_has_a_distinct_name) {
    std::set<std::string_view> names;
    for (const InputTraits& traits : k_input_traits)
        EXPECT_TRUE(names.insert(traits.name).second) << traits.name;
    EXPECT_EQ(traits_of(Keyboard{}).name, "keyboard");
}

TEST(ChannelInput, generated_inputs_have_names) {
    EXPECT_EQ(generated_input("noise"), ChannelInput(Noise{}));
    EXPECT_EQ(generated_input("keyboard"), ChannelInput(Keyboard{}));
    EXPECT_EQ(generated_input("microphone"), ChannelInput(Music{}));
    EXPECT_EQ(generated_input("webcam"), ChannelInput(Video{}));
    EXPECT_EQ(generated_input("none"), std::nullopt) << "for --channel alone";
    EXPECT_EQ(generated_input("noise.png"), std::nullopt);
}

TEST(ChannelInput, files_of_an_input_are_listed) {
    EXPECT_THAT(input_files(Picture{"a.png"}), ElementsAre("a.png"));
    EXPECT_THAT(input_files(Cubemap{{"a.png", "b.png"}}), ElementsAre("a.png", "b.png"));
    EXPECT_THAT(input_files(Music{}), IsEmpty());
    EXPECT_THAT(input_files(Noise{}), IsEmpty());
}

TEST(ChannelInput, pass_numbers_of_inputs_are_renumbered) {
    ChannelInput input = PassOutput{3};
    *source_pass(input) = 1;
    EXPECT_EQ(input, ChannelInput(PassOutput{1}));
    EXPECT_EQ(source_pass(ChannelInput(Keyboard{})), nullptr);
}

} // namespace tidemark::scene::channel_input_test
