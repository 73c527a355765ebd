#include "scene/channel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace tidemark::scene::channel_input_test {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ChannelInput, each_kind_has_a_name_of_its_own) {
    std::set<std::string_view> names;
    for (const InputTraits& traits : k_input_traits)
        EXPECT_TRUE(names.insert(traits.name).second) << traits.name;
    EXPECT_EQ(traits_of(Keyboard{}).name, "keyboard");
}

TEST(ChannelInput, some_are_asked_for_by_name) {
    EXPECT_EQ(generated_input("noise"), ChannelInput(Noise{}));
    EXPECT_EQ(generated_input("keyboard"), ChannelInput(Keyboard{}));
    EXPECT_EQ(generated_input("microphone"), ChannelInput(Music{}));
    EXPECT_EQ(generated_input("webcam"), ChannelInput(Video{}));
    EXPECT_EQ(generated_input("none"), std::nullopt) << "for --channel alone";
    EXPECT_EQ(generated_input("noise.png"), std::nullopt);
}

TEST(ChannelInput, files_are_those_that_it_names) {
    EXPECT_THAT(input_files(Picture{"a.png"}), ElementsAre("a.png"));
    EXPECT_THAT(input_files(Cubemap{{"a.png", "b.png"}}), ElementsAre("a.png", "b.png"));
    EXPECT_THAT(input_files(Music{}), IsEmpty());
    EXPECT_THAT(input_files(Noise{}), IsEmpty());
}

TEST(ChannelInput, a_pass_is_read_by_its_number_which_may_change) {
    ChannelInput input = PassOutput{3};
    *source_pass(input) = 1;
    EXPECT_EQ(input, ChannelInput(PassOutput{1}));
    EXPECT_EQ(source_pass(ChannelInput(Keyboard{})), nullptr);
}

} // namespace tidemark::scene::channel_input_test
