// Shards share the frames: each is made once.
#include "cli/capture_frames.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

namespace tidemark::cli::shard_test {

std::vector<int> frames_up_to(int count) {
    std::vector<int> frames(size_t(count), 0);
    std::iota(frames.begin(), frames.end(), 0);
    return frames;
}

scene::Scene scene_with(scene::PassKind kind) {
    scene::Scene scene;
    scene.passes.resize(1);
    scene.passes[0].kind = kind;
    return scene;
}

TEST(Shard, every_frame_belongs_to_exactly_one_shard) {
    for (const auto kind : {scene::PassKind::image, scene::PassKind::buffer})
        for (const int count : {1, 2, 3, 7, 40}) {
            std::vector<int> all;
            for (int index = 0; index < count; ++index)
                std::ranges::copy(frames_of({index, count}, frames_up_to(20), scene_with(kind)),
                                  std::back_inserter(all));
            std::ranges::sort(all);
            EXPECT_EQ(all, frames_up_to(20)) << count;
        }
}

TEST(Shard, is_a_contiguous_range_for_scenes_with_buffers) {
    EXPECT_THAT(frames_of({1, 3}, frames_up_to(7), scene_with(scene::PassKind::buffer)),
                testing::ElementsAre(2, 3));
    EXPECT_THAT(frames_of({1, 3}, frames_up_to(7), scene_with(scene::PassKind::image)),
                testing::ElementsAre(1, 4));
}

TEST(Shard, index_is_parsed_from_1) {
    const auto shard = parse_shard("2/8");
    ASSERT_TRUE(shard);
    EXPECT_EQ(shard->index, 1);
    EXPECT_EQ(shard->count, 8);
    for (const char* text : {"", "/", "0/2", "3/2", "-1/2", "1/2 ", "1/99999999"})
        EXPECT_FALSE(parse_shard(text)) << text;
}

} // namespace tidemark::cli::shard_test
