#include "cli/capture_delivery.hpp"

#include "host/console.hpp"
#include "host/gl_context.hpp"
#include "host/moment.hpp"
#include "host/scene_report.hpp"
#include "media/file_samples.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tidemark::cli {

using namespace host;
namespace {

void find(FrameRecords::Found& found, size_t pixels, const FrameRecord& record) {
    if (pixels == 0)
        return;
    ++found.count;
    if (!found.first)
        found.first = record;
}

/// Returns the picture with its right column and its bottom row repeated up to that size, which is at most
/// one larger.
image::Image padded(const image::Image& picture, Extent size) {
    image::Image all(size, picture.channels, picture.type);
    const size_t row = picture.row_bytes();
    const size_t pixel = size_t(picture.channels) * image::size_of(picture.type);
    const int below = size.height - picture.extent.height; // row 0 is the bottom row
    for (int y = 0; y < size.height; ++y) {
        const std::byte* const from = picture.bytes.data() + size_t(std::max(0, y - below)) * row;
        std::byte* const to = all.bytes.data() + size_t(y) * all.row_bytes();
        std::copy_n(from, row, to);
        if (all.row_bytes() > row)
            std::copy_n(from + row - pixel, pixel, to + row);
    }
    return all;
}

constexpr size_t k_block_bytes = 1 << 18; ///< fits a processor's cache while it is filled and written

/// One picture of a pass that is not shown.
struct Source {
    std::string name;
    size_t pass;
    int face = 0;
    bool cube = false;
};

std::vector<Source> sources(const render::Renderer& renderer) {
    std::vector<Source> all;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const scene::Pass& pass = renderer.scene().passes[planned.pass];
        if (planned.pass == renderer.shown_index())
            continue;
        if (pass.kind != scene::PassKind::cubemap) {
            all.push_back({pass.name, planned.pass});
            continue;
        }
        for (int face = 0; face < int(k_face_names.size()); ++face)
            all.push_back(
                {fmt::format("{} {}", pass.name, k_face_names[size_t(face)]), planned.pass, face, true});
    }
    return all;
}

/// Writes RGB bytes to standard output, rows from the top down, as video tools read raw frames.
Result<void> put_raw(const image::Image& image) {
    const size_t row_bytes = size_t(image.extent.width) * 3;
    const size_t rows_at_once = std::max<size_t>(1, k_block_bytes / row_bytes);
    std::vector<std::byte> block;
    for (int row = image.extent.height; row > 0;) {
        const auto rows = int(std::min(rows_at_once, size_t(row)));
        block.resize(size_t(rows) * row_bytes);
        for (int i = 0; i < rows; ++i)
            copy_colours(image, --row, block.data() + size_t(i) * row_bytes);
        if (auto done = put(block); !done)
            return done;
    }
    return {};
}

/// Returns the other passes in the order of drawing: `Buffer A`, and for a cube `Cube A px` to `Cube A nz`.
/// Each has the orientation of a file with that pass or face alone, but always with alpha, so that all frames
/// of a sequence have the same channels. Passes as large as the frame are cut to `crop`, a cube's faces are
/// not.
std::vector<image::PictureLayer> other_layers(const render::Renderer& renderer, image::SampleDepth depth,
                                              const std::optional<Rectangle>& crop) {
    const image::PictureFormat format{
        .depth = depth, .transfer = image::Transfer::data, .alpha = image::Alpha::straight};
    std::vector<image::PictureLayer> layers;
    for (const Source& source : sources(renderer)) {
        image::Image drawn = renderer.read_floats(source.pass, source.face);
        if (source.cube)
            drawn = image::flipped(drawn); // the first row of a face is its top row
        else if (crop)
            drawn = image::cropped(std::move(drawn), *crop);
        layers.push_back({source.name, std::move(drawn), format});
    }
    return layers;
}

} // namespace

void FrameRecords::add(FrameRecord record) {
    ++count_;
    if (!first_)
        first_ = record;
    find(not_finite_, record.not_finite, record);
    find(no_coverage_, record.no_coverage, record);
    if (listed_)
        list_.push_back(record);
    last_ = std::move(record);
}

std::vector<image::Image> laid_out(DrawnPixels pixels, bool six_faces) {
    std::vector<image::Image> pictures;
    if (auto* const picture = std::get_if<image::Image>(&pixels)) {
        pictures.push_back(std::move(*picture));
        return pictures;
    }
    const auto& cube = std::get<image::CubeFaces>(pixels);
    if (!six_faces)
        pictures.push_back(image::equirectangular_of(cube));
    for (size_t face = 0; six_faces && face < cube.size(); ++face)
        pictures.push_back(image::flipped(cube[face])); // the first row of a face is its top row
    return pictures;
}

void add_rows(Sha256& hash, const image::Image& image) {
    const std::span<const std::byte> bytes(image.bytes);
    for (auto row = size_t(image.extent.height); row-- > 0;)
        hash.add(bytes.subspan(row * image.row_bytes(), image.row_bytes()));
}

BandOutput::BandOutput(std::optional<image::PictureStream> stream, Extent drawn,
                       std::optional<Rectangle> crop, bool hashed)
    : stream_(std::move(stream)), rows_(drawn.height), crop_(crop) {
    if (hashed)
        hash_.emplace();
}

Result<image::Image> BandOutput::take(image::Image band) {
    TRY(wait());
    std::swap(band, band_);
    writing_ = std::async(std::launch::async, [this] { return write(); });
    return band;
}

Result<void> BandOutput::write() {
    rows_ -= band_.extent.height;
    if (crop_) {
        const Rectangle part = crop_->within({0, rows_, band_.extent});
        if (part.extent.pixels() == 0)
            return {};
        band_ = image::cropped(std::move(band_), {part.x, part.y - rows_, part.extent});
    }
    not_finite_ += image::take_non_finite(band_);
    if (band_.type == image::SampleType::f32)
        no_coverage_ += image::pixels_of_no_coverage(band_);
    if (hash_)
        add_rows(*hash_, band_);
    return stream_ ? stream_->add(band_) : put_raw(band_);
}

Result<void> BandOutput::wait() {
    return writing_.valid() ? writing_.get() : Result<void>();
}

Result<void> BandOutput::finish() {
    return wait().and_then([&] { return stream_ ? stream_->finish() : Result<void>(); });
}

std::vector<std::string> layer_names(const render::Renderer& renderer) {
    std::vector<std::string> names{renderer.shown_pass().name};
    for (const Source& source : sources(renderer))
        names.push_back(source.name);
    return names;
}

Delivery::Delivery(const CapturePlan& plan, const render::Renderer& renderer, const gl::Capabilities& driver,
                   Watchdog& watchdog, std::filesystem::path sound)
    : plan_(plan), renderer_(renderer), driver_(driver), watchdog_(watchdog), sound_(std::move(sound)),
      records_(plan.options.run.json || plan.area.sheet.has_value()) {}

bool Delivery::in_bands() const {
    return renderer_.tiles() && !(plan_.drawing.exposure.several() && renderer_.tiles()->count() == 1);
}

Result<void> Delivery::open(const Interrupt& interrupt) {
    interrupt_ = &interrupt;
    if (plan_.output.video()) {
        video_.emplace(TRY(SegmentedVideo::create(plan_, plan_.area.written)));
    } else if (plan_.area.sheet) {
        sheet_.emplace(*plan_.area.sheet);
    } else if (!plan_.output.standard_output() && !in_bands()) {
        // Two encoders are enough: the driver keeps the cores busy while it draws.
        const auto encoders = unsigned(std::min<size_t>(2, plan_.frames.frames.size()));
        // Frames with all passes are large, so fewer wait.
        writer_ = std::make_unique<FrameWriter>(encoders, plan_.encoding.layers ? 1 : encoders + 1);
    }
    return {};
}

Result<void> Delivery::close() {
    if (video_ && plan_.shard)
        return {}; // `gather` joins it
    if (video_)
        return encode("joining the video", {}, [&] { return video_->finish(sound_); });
    if (sheet_)
        return image::write_picture(plan_.output.of_frame(plan_.frames.frames.front()), sheet_->picture(),
                                    format_of_sheet());
    return writer_ ? writer_->finish() : Result<void>();
}

Result<void> Delivery::stop() {
    if (video_)
        video_->drop();
    return writer_ ? writer_->finish() : Result<void>();
}

void Delivery::rescue() {
    // Otherwise the main thread is using it, and its encoder ends with our process.
    if (video_ && !in_encoder_)
        video_->drop();
    if (writer_)
        (void)writer_->finish();
}

size_t Delivery::written() {
    constexpr size_t k_faces = 6;
    return video_    ? video_->written()
           : sheet_  ? size_t{0}
           : writer_ ? writer_->written() / (plan_.output.six_faces() ? k_faces : 1)
                     : records_.count();
}

WrittenFrame Delivery::prepare(DrawnFrame drawn) const {
    WrittenFrame frame{std::move(drawn.record), laid_out(std::move(drawn.pixels), plan_.output.six_faces())};
    auto& [record, pictures] = frame;
    if (plan_.area.crop)
        for (image::Image& picture : pictures)
            picture = image::cropped(std::move(picture), *plan_.area.crop);
    if (!plan_.drawing.lens)
        record.not_finite = count_not_finite(renderer_, pictures, plan_.area.crop);
    for (image::Image& picture : pictures)
        if (plan_.keeps_alpha())
            record.no_coverage += image::pixels_of_no_coverage(picture);
        else if (plan_.encoding.depth == image::SampleDepth::u8)
            picture = image::in_bytes(std::move(picture));
    if (plan_.area.padded)
        for (image::Image& picture : pictures)
            picture = padded(picture, plan_.area.written);
    return frame;
}

Result<bool> Delivery::deliver(WrittenFrame frame) {
    auto& [record, pictures] = frame;
    if (plan_.options.run.json) {
        Sha256 hash;
        for (const image::Image& picture : pictures)
            add_rows(hash, picture);
        record.sha256 = hash.digits();
    }
    const bool wanted = TRY(write(record, std::move(pictures)));
    if (wanted)
        records_.add(std::move(record));
    return wanted;
}

Result<bool> Delivery::write(const FrameRecord& record, std::vector<image::Image> pictures) {
    image::Image& first = pictures.front();
    if (video_) {
        auto encoded = encode(fmt::format("encoding frame {}", record.frame), plan_.options.run.timeout,
                              [&] { return video_->push(first); });
        return encoded.map([] { return true; }).map_error([&](Error error) {
            error.message += fmt::format(" (in frame {})", record.frame);
            return error;
        });
    }
    if (sheet_) {
        sheet_->add(first);
        return true;
    }
    if (!writer_)
        return put_raw(first).map([] { return true; });
    if (plan_.encoding.layers)
        return writer_->push(
            {record.frame, plan_.output.of_frame(record.frame), {}, {}, layers_of(record, std::move(first))});
    bool wanted = true;
    for (size_t i = 0; wanted && i < pictures.size(); ++i)
        wanted = writer_->push({record.frame,
                                plan_.output.six_faces() ? plan_.output.of_face(record.frame, i)
                                                         : plan_.output.of_frame(record.frame),
                                std::move(pictures[i]), format_of(record.frame)});
    return wanted;
}

/// Runs work that waits for ffmpeg, which may hang: Ctrl-C then ends the process.
Result<void> Delivery::encode(std::string what, std::optional<double> limit,
                              const std::function<Result<void>()>& work) {
    const Watchdog::Watch watch(watchdog_, {.what = std::move(what),
                                            .limit_seconds = limit,
                                            .unwanted = [this] { return interrupt_->requested(); }});
    in_encoder_ = true;
    auto outcome = work();
    in_encoder_ = false;
    return outcome;
}

Result<std::unique_ptr<BandOutput>> Delivery::open_bands(int frame) const {
    std::optional<image::PictureStream> stream;
    if (!plan_.output.standard_output()) {
        const bool alpha = plan_.keeps_alpha() || renderer_.shown_pass().kind != scene::PassKind::image;
        stream.emplace(TRY(image::PictureStream::create(plan_.output.of_frame(frame), plan_.area.written,
                                                        alpha, format_of(frame))));
    }
    return std::make_unique<BandOutput>(std::move(stream), renderer_.extent(), plan_.area.crop,
                                        plan_.options.run.json);
}

void Delivery::add(FrameRecord record, BandOutput& bands) {
    record.sha256 = bands.sha256();
    record.not_finite = bands.not_finite();
    record.no_coverage = plan_.keeps_alpha() ? bands.no_coverage() : 0;
    records_.add(std::move(record));
}

std::vector<image::PictureLayer> Delivery::layers_of(const FrameRecord& record, image::Image picture) const {
    std::vector<image::PictureLayer> layers;
    layers.push_back({renderer_.shown_pass().name, std::move(picture), format_of(record.frame)});
    std::ranges::move(other_layers(renderer_, *plan_.encoding.layers, plan_.area.crop),
                      std::back_inserter(layers));
    return layers;
}

image::PictureFormat Delivery::format_of(int frame) const {
    const render::FrameState state = plan_.states(frame);
    // The fingerprint goes first: a JPEG without room for all metadata keeps the first entries.
    image::PictureFormat format{plan_.encoding.depth,
                                {{k_fingerprint, plan_.identity.of_frame(state).text()}},
                                plan_.encoding.transfer,
                                plan_.encoding.alpha};
    for (auto& fact : metadata_of(renderer_.scene(), moment_of(plan_.options.scene, plan_.frames, state)))
        format.metadata.push_back(std::move(fact));
    const Extent extent = renderer_.extent();
    format.metadata.insert(format.metadata.end(),
                           {{"Size", fmt::format("{}x{}", extent.width, extent.height)},
                            {"Pass", renderer_.shown_pass().name},
                            {"Precision", name_of(renderer_.precision())},
                            {"Driver", fmt::format("{}, OpenGL {}", driver_.device(), driver_.version)}});
    if (plan_.keeps_alpha())
        format.metadata.emplace_back(
            "Alpha", plan_.encoding.alpha == image::Alpha::straight ? "straight" : "premultiplied");
    if (plan_.drawing.lens)
        format.metadata.emplace_back("Lens", lab::to_string(plan_.drawing.lens->lens));
    if (plan_.area.crop)
        format.metadata.emplace_back(k_crop, to_string(*plan_.area.crop));
    if (plan_.drawing.exposure.several())
        format.metadata.emplace_back("Samples", std::to_string(plan_.drawing.exposure.samples));
    if (plan_.drawing.exposure.shutter > 0)
        format.metadata.emplace_back("Shutter", fmt::format("{}", plan_.drawing.exposure.shutter));
    if (!plan_.options.scene.defines.empty())
        format.metadata.emplace_back("Defines",
                                     fmt::format("{}", fmt::join(plan_.options.scene.defines, "; ")));
    return format;
}

/// Returns the metadata that the sheet's moments share, and the list of moments.
image::PictureFormat Delivery::format_of_sheet() const {
    image::PictureFormat format = format_of(records_.first().frame);
    constexpr std::string_view k_of_one[] = {k_fingerprint, k_moment, "Frame", "iTime", "iMouse", "Camera"};
    std::erase_if(format.metadata, [&](const auto& fact) {
        return std::ranges::find(k_of_one, fact.first) != std::end(k_of_one);
    });
    std::vector<int> frames;
    std::vector<double> times;
    for (const FrameRecord& record : records_.list()) {
        frames.push_back(record.frame);
        times.push_back(plan_.states(record.frame).seconds());
    }
    format.metadata.emplace_back("Sheet",
                                 fmt::format("{}x{}", plan_.area.sheet->columns, plan_.area.sheet->rows));
    format.metadata.emplace_back("Frames", fmt::format("{}", fmt::join(frames, ",")));
    format.metadata.emplace_back("Times", fmt::format("{}", fmt::join(times, ",")));
    return format;
}

} // namespace tidemark::cli
