#include "serve/plugin/vp8.hpp"

#include <libyuv/convert.h>
#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

#include <algorithm>
#include <thread>

namespace tidemark::serve {
namespace {

/// libvpx's speed level for real-time encoding, close to the fastest: faster ones lose more than they save.
constexpr int k_speed = -12;
constexpr int k_coarsest = 63; ///< quantizer
constexpr int k_thousand = 1000;

struct DestroyImage {
    void operator()(vpx_image_t* image) const { vpx_img_free(image); }
};

/// An encoder of one size.
class Encoder {
public:
    Encoder() = default;
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
    ~Encoder() { close(); }

    Extent extent() const { return extent_; }

    bool open(Extent extent, int quality) {
        close();
        vpx_codec_enc_cfg_t settings{};
        if (vpx_codec_enc_config_default(vpx_codec_vp8_cx(), &settings, 0) != VPX_CODEC_OK)
            return false;
        settings.g_w = unsigned(extent.width);
        settings.g_h = unsigned(extent.height);
        settings.g_timebase = {1, k_thousand};
        settings.g_lag_in_frames = 0;
        settings.g_threads = std::clamp(std::thread::hardware_concurrency() / 2, 1U, 4U);
        settings.kf_mode = VPX_KF_DISABLED; // key pictures come only on request
        // A fixed quantizer sets the quality: with a target rate, moving pictures would be late or worse
        // because of earlier ones.
        settings.rc_end_usage = VPX_VBR;
        settings.rc_target_bitrate = 1 << 20;
        settings.rc_min_quantizer = settings.rc_max_quantizer = unsigned((100 - quality) * k_coarsest / 100);
        image_.reset(vpx_img_alloc(nullptr, VPX_IMG_FMT_I420, settings.g_w, settings.g_h, 16));
        is_open_ = image_ && vpx_codec_enc_init(&codec_, vpx_codec_vp8_cx(), &settings, 0) == VPX_CODEC_OK;
        if (is_open_)
            vpx_codec_control(&codec_, VP8E_SET_CPUUSED, k_speed);
        extent_ = is_open_ ? extent : Extent{};
        return is_open_;
    }

    std::string encode(std::span<const std::byte> rgba, bool key) {
        const auto* pixels = reinterpret_cast<const uint8_t*>(rgba.data());
        // BT.601 colours, which browsers assume for VP8; the height is negative because the bottom row is
        // first.
        libyuv::ABGRToI420(pixels, 4 * extent_.width, image_->planes[0], image_->stride[0], image_->planes[1],
                           image_->stride[1], image_->planes[2], image_->stride[2], extent_.width,
                           -extent_.height);
        const vpx_enc_frame_flags_t flags = key ? VPX_EFLAG_FORCE_KF : 0;
        std::string film;
        if (vpx_codec_encode(&codec_, image_.get(), time_++, 1, flags, VPX_DL_REALTIME) != VPX_CODEC_OK)
            return film;
        vpx_codec_iter_t place = nullptr;
        while (const vpx_codec_cx_pkt_t* const packet = vpx_codec_get_cx_data(&codec_, &place))
            if (packet->kind == VPX_CODEC_CX_FRAME_PKT)
                film.append(static_cast<const char*>(packet->data.frame.buf), packet->data.frame.sz);
        return film;
    }

private:
    void close() {
        if (is_open_)
            vpx_codec_destroy(&codec_);
        is_open_ = false;
    }

    Extent extent_{};
    bool is_open_ = false;
    vpx_codec_ctx_t codec_{};
    vpx_codec_pts_t time_ = 0;
    std::unique_ptr<vpx_image_t, DestroyImage> image_{};
};

class Vp8 : public Film {
public:
    explicit Vp8(int quality) : quality_(quality) {}

    std::string encode(Extent extent, std::span<const std::byte> rgba, bool key) override {
        if (extent != encoder_.extent() && !encoder_.open(extent, quality_))
            return {};
        return encoder_.encode(rgba, key);
    }

private:
    int quality_;
    Encoder encoder_;
};

} // namespace

std::unique_ptr<Film> open_vp8(int quality) {
    return std::make_unique<Vp8>(quality);
}

} // namespace tidemark::serve
