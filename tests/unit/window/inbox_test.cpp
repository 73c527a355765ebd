#include "window/midi.hpp"

#include <gmock/gmock.h>

namespace tidemark::window::inbox_test {

using testing::ElementsAre;

TEST(Inbox, returns_packets_in_order_and_wakes_once) {
    int woken = 0;
    Inbox inbox([&] { ++woken; });
    inbox.put("a");
    inbox.put("b");
    EXPECT_EQ(woken, 1);
    EXPECT_THAT(inbox.take(), ElementsAre("a", "b"));
    EXPECT_TRUE(inbox.empty());
    inbox.put("c");
    EXPECT_EQ(woken, 2);
}

TEST(Inbox, holds_no_more_than_can_be_read_between_two_frames) {
    Inbox inbox([] {});
    constexpr size_t k_longest = 1 << 16; // of UDP
    for (int i = 0; i < 1000; ++i)
        inbox.put(std::string(k_longest, char('a' + i % 26)));
    const auto taken = inbox.take();
    size_t bytes = 0;
    for (const std::string& packet : taken)
        bytes += packet.size();
    EXPECT_LE(bytes, size_t(1) << 20);
    EXPECT_EQ(taken.back().front(), char('a' + 999 % 26)) << "the newest stay";
    for (int i = 0; i < 10000; ++i)
        inbox.put(std::to_string(i));
    EXPECT_EQ(inbox.take().size(), 4096u) << "its bytes are counted anew";
    inbox.put(std::string(size_t(4) << 20, 'x'));
    EXPECT_EQ(inbox.take().size(), 1u) << "one is always taken";
}

} // namespace tidemark::window::inbox_test
