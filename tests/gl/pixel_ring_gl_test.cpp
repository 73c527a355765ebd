// Pixels that are read back while later frames are drawn.
#include "gl_test.hpp"
#include "render/gl_sync.hpp"

namespace tidemark::gl::pixel_ring_gl_test {

using render::RenderTest;

class PixelRingTest : public RenderTest {
protected:
    static void paint(const RenderTarget& target, float red) {
        const GLfloat colour[] = {red, 0.25f, 0, 1};
        glClearNamedFramebufferfv(target.framebuffer.id(), GL_COLOR, 0, colour);
    }
    static bool read(PixelRing& ring, const RenderTarget& target, Extent size) {
        return ring.read(target, size, GL_RGBA, GL_FLOAT, 16 * size.pixels());
    }
    static std::vector<float> taken(PixelRing& ring) {
        const auto bytes = ring.take();
        std::vector<float> floats(bytes.size() / 4);
        std::ranges::copy(bytes, std::as_writable_bytes(std::span(floats)).begin());
        return floats;
    }
    RenderTarget target_ = *make_render_target(make_texture({5, 3}, GL_RGBA32F, 1));
};

TEST_F(PixelRingTest, returns_pictures_in_order_as_read) {
    PixelRing ring(3);
    for (int round = 0; round < 4; ++round) {
        for (int i = 0; i < 3; ++i) {
            paint(target_, float(10 * round + i));
            ASSERT_FALSE(ring.full());
            ASSERT_TRUE(read(ring, target_, target_.extent()));
        }
        EXPECT_TRUE(ring.full());
        paint(target_, -1); // seen by none
        for (int i = 0; i < 3; ++i) {
            const auto floats = taken(ring);
            ASSERT_EQ(floats.size(), 5U * 3 * 4);
            for (size_t k = 0; k < floats.size(); k += 4)
                EXPECT_EQ(floats[k], float(10 * round + i));
        }
        EXPECT_TRUE(ring.empty());
    }
    EXPECT_EQ(ring.bytes(), 3U * 5 * 3 * 16);
}

TEST_F(PixelRingTest, reads_while_earlier_pictures_wait) {
    PixelRing ring(2);
    for (int i = 0; i < 20; ++i) {
        if (ring.full()) {
            EXPECT_EQ(taken(ring)[0], float(i - 2));
        }
        paint(target_, float(i));
        ASSERT_TRUE(read(ring, target_, target_.extent()));
    }
    EXPECT_EQ(taken(ring)[0], 18);
    EXPECT_EQ(taken(ring)[0], 19);
}

TEST_F(PixelRingTest, takes_another_size) {
    PixelRing ring(1);
    for (const Extent size : {Extent{5, 3}, Extent{2, 2}, Extent{5, 1}}) {
        ASSERT_TRUE(read(ring, target_, size));
        EXPECT_EQ(taken(ring).size(), 4 * size.pixels());
        EXPECT_EQ(ring.bytes(), 16 * size.pixels());
    }
}

TEST_F(PixelRingTest, reports_missing_memory) {
    PixelRing ring(1);
    EXPECT_FALSE(ring.read(target_, {1, 1}, GL_RGBA, GL_FLOAT, size_t{1} << 62));
    EXPECT_TRUE(ring.empty());
    EXPECT_EQ(ring.bytes(), 0U);
    EXPECT_TRUE(read(ring, target_, {1, 1}));
}

} // namespace tidemark::gl::pixel_ring_gl_test
