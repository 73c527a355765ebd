#include "cli/capture_resume.hpp"

#include "base/encoding.hpp"
#include "host/json.hpp"
#include "host/moment.hpp"
#include "media/picture_check.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <map>
#include <numeric>
#include <system_error>
#include <thread>

namespace tidemark::cli {

using namespace host;
namespace fs = std::filesystem;
namespace {

Json knob_facts(const scene::Scene& scene) {
    Json facts = Json::array();
    for (const scene::Knob& knob : scene.knobs)
        facts.push_back(Json::array({knob.name, int(knob.type), knob.value}));
    return facts;
}

/// Leaves out size and pass, which belong to the frame, and tiles and trials without an allowed difference,
/// which do not change pictures.
Json drawing_facts(const CapturePlan& plan) {
    const auto& [extent, samples, pass, precision, specialise, extras, tile, marks, keeps_alpha] =
        plan.drawing.options;
    const bool differs = plan.drawing.trial && plan.drawing.trial->allowed;
    Json facts = Json::array({int(samples), int(precision), int(specialise), marks, int(plan.encoding.depth),
                              plan.output.pattern().extension().string(), plan.output.six_faces(),
                              plan.output.video() ? Json(plan.video.pace.fps) : Json(),
                              differs ? Json(*plan.drawing.trial->allowed) : Json()});
    if (plan.drawing.exposure.several())
        facts.push_back(Json::array({plan.drawing.exposure.samples, plan.drawing.exposure.shutter}));
    if (plan.encoding.transfer != drawn_transfer(pass))
        facts.push_back(Json::array({"transfer", int(plan.encoding.transfer)}));
    if (!plan.video.codec.empty())
        facts.push_back(Json::array({"codec", plan.video.codec}));
    if (plan.output.video() && plan.video.pace.holds)
        facts.push_back(Json::array({"ticks", ticks_of(plan.frames.frames, plan.video.pace)}));
    if (keeps_alpha)
        facts.push_back(Json::array({"alpha", int(plan.encoding.alpha)}));
    if (plan.encoding.layers)
        facts.push_back(Json::array({"layers", int(*plan.encoding.layers)}));
    if (plan.drawing.lens)
        facts.push_back(Json::array({"lens", lab::to_string(plan.drawing.lens->lens)}));
    if (plan.area.crop)
        facts.push_back(Json::array({"crop", to_string(*plan.area.crop)}));
    if (plan.area.padded)
        facts.push_back(Json::array({"pad", plan.options.encoding.pad}));
    return facts;
}

constexpr std::string_view k_ending = ".state";
constexpr int k_version_of_format = 1;
constexpr size_t k_checksum = 64;
constexpr uint64_t k_most_floats = uint64_t{1} << 40; ///< larger than any disk
constexpr size_t k_longest_header = size_t{1} << 20;  ///< bytes

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// Returns the header, one line. The textures follow it, then the checksum of everything before.
std::string header_of(const SavedState& state, const Fingerprint& fingerprint) {
    Json passes = Json::array();
    for (const render::PassState& pass : state.buffers) {
        Json& sizes = passes.emplace_back(Json::array({pass.pass, Json::array()}))[1];
        for (const render::TextureFloats& texture : pass.textures)
            sizes.push_back(texture.size());
    }
    return dump(Json{{"tidemark_state", k_version_of_format},
                     {"fingerprint", fingerprint.text()},
                     {"frame", state.frame},
                     {"program", int(state.program)},
                     {"passes", passes}}) +
           "\n";
}

/// Takes floats from the front of `rest`; returns false if there are too few.
bool take(std::string_view& rest, size_t count, render::TextureFloats& texture) {
    if (count > rest.size() / sizeof(float))
        return false;
    texture.resize(count);
    std::memcpy(texture.data(), rest.data(), count * sizeof(float));
    rest.remove_prefix(count * sizeof(float));
    return true;
}

/// Returns the size of the whole file in bytes, according to its header. Throws for an unknown header.
uint64_t size_of(const Json& header, uint64_t header_bytes) {
    uint64_t floats = 0;
    for (const Json& pass : header.at("passes"))
        for (const Json& count : pass.at(1))
            floats += std::min(count.get<uint64_t>(), k_most_floats);
    return header_bytes + std::min(floats, k_most_floats) * sizeof(float) + k_checksum;
}

/// Throws for an unknown header.
std::optional<SavedState> parse(const Json& header, std::string_view rest) {
    const auto program = header.at("program").get<unsigned char>();
    if (program > static_cast<unsigned char>(glsl::Specialise::constants))
        return std::nullopt;
    SavedState state{header.at("frame").get<int>(), glsl::Specialise(program)};
    for (const Json& pass : header.at("passes")) {
        state.buffers.push_back({pass.at(0).get<std::string>(), {}});
        render::PassState& into = state.buffers.back();
        for (const Json& floats : pass.at(1))
            if (!take(rest, floats.get<size_t>(), into.textures.emplace_back()))
                return std::nullopt;
    }
    return state;
}

/// Checks that the last 64 bytes are the checksum of all others, and returns those; nothing if it does not
/// match.
std::optional<std::string_view> without_checksum(std::string_view file) {
    if (file.size() < k_checksum)
        return std::nullopt;
    const std::string_view content = file.substr(0, file.size() - k_checksum);
    return file.substr(content.size()) == sha256(bytes_of(content)) ? std::optional(content) : std::nullopt;
}

/// The usual distance of key frames in libx264, so that a long video does not grow by its segments.
constexpr int k_default_length = 250;

size_t ticks_in(const VideoSegment& segment) {
    return std::accumulate(segment.ticks.begin(), segment.ticks.end(), size_t{0});
}

/// Returns why the picture in the file does not have this fingerprint; empty if it does.
std::string why_not_kept(const fs::path& file, const Fingerprint& wanted) {
    const auto metadata = image::read_metadata(file);
    if (!metadata)
        return metadata.error();
    const std::string* text = image::find(*metadata, k_fingerprint);
    if (!text)
        return "it has no record of how it was drawn";
    const std::string differences = wanted.differences(Fingerprint::parse(*text));
    return differences.empty() ? "" : "it was drawn with " + differences;
}

/// Returns the first file that cannot be kept, and why; an empty reason means that it is missing. Returns
/// nothing if the frame is kept.
std::optional<std::pair<fs::path, std::string>> objection_to(const std::vector<fs::path>& files,
                                                             const Fingerprint& wanted) {
    std::error_code ignored;
    for (const fs::path& file : files) {
        if (!fs::is_regular_file(fs::symlink_status(file, ignored)))
            return std::pair(file, std::string());
        if (std::string why = why_not_kept(file, wanted); !why.empty())
            return std::pair(file, std::move(why));
    }
    return std::nullopt;
}

KeptFrames leave_out_pictures(CapturePlan& plan) {
    KeptFrames kept;
    std::vector<int> missing;
    std::vector<Wrong> again;
    for (const int frame : plan.frames.frames) {
        auto objection = objection_to(files_of(plan.output, frame), plan.identity_of(frame));
        (objection ? missing : kept.frames).push_back(frame);
        if (!objection)
            continue;
        if (!objection->second.empty())
            note(again, std::move(objection->second), objection->first.string());
    }
    for (const auto& [why, first, count] : again)
        kept.said.push_back(count == 1
                                ? fmt::format("drawing {} again: {}", first, why)
                                : fmt::format("drawing {} frames again, from {}: {}", count, first, why));
    plan.frames.frames = std::move(missing);
    return kept;
}

KeptFrames leave_out_segments(CapturePlan& plan) {
    KeptFrames kept;
    std::vector<int> missing;
    for (size_t i = 0; i < plan.video.segments.size(); ++i) {
        VideoSegment& segment = plan.video.segments[i];
        if (segment.others)
            continue;
        const auto note = image::note_of_segment(segment_file(plan.output, i).path());
        segment.kept = note && *note == note_of(plan, segment);
        std::vector<int>& into = segment.kept ? kept.frames : missing;
        into.insert(into.end(), segment.frames.begin(), segment.frames.end());
        if (note && !segment.kept)
            kept.said.push_back(fmt::format(
                "drawing frames {} to {} again: they were drawn with {}", segment.frames.front(),
                segment.frames.back(),
                Fingerprint::parse(note_of(plan, segment)).differences(Fingerprint::parse(*note))));
    }
    plan.frames.frames = std::move(missing);
    return kept;
}

/// Writes the state; it is on disk when the function returns. Fails with ErrorCode::write.
Result<void> write_state(const OutputPath& file, const SavedState& state, const Fingerprint& fingerprint) {
    auto staged = TRY(StagedFile::create(file));
    Sha256 hash;
    const auto add = [&](std::span<const std::byte> bytes) {
        hash.add(bytes);
        return staged.write(bytes);
    };
    TRY(add(bytes_of(header_of(state, fingerprint))));
    for (const render::PassState& pass : state.buffers)
        for (const render::TextureFloats& texture : pass.textures)
            TRY(add(std::as_bytes(std::span(texture))));
    TRY(staged.write(bytes_of(hash.digits())));
    if (!state.buffers.empty())
        ::fsync(staged.descriptor()); // the previous state is removed next
    return staged.commit();
}

} // namespace

Fingerprint identity_of_run(const CapturePlan& plan) {
    Fingerprint run = Fingerprint::of_scene(plan.scene, plan.options.scene.defines, plan.frames);
    run.add("knobs", knob_facts(plan.scene));
    run.add("drawing", drawing_facts(plan));
    return run;
}

OutputPath state_file(const OutputName& output, int frame) {
    return output.of_frame(frame).beside(k_ending);
}

std::vector<fs::path> find_states(const OutputName& output) {
    std::multimap<int, fs::path, std::greater<>> found;
    const fs::path folder = output.of_frame(0).path().parent_path();
    std::error_code ignored;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, ignored), end;
         !ignored && entry != end; entry.increment(ignored)) {
        const fs::path& file = entry->path();
        if (file.extension() != k_ending || !fs::is_regular_file(entry->symlink_status(ignored)))
            continue;
        const fs::path picture = fs::path(file).replace_extension();
        // One file for all frames, or that of frame 0.
        if (output.of_frame(0).path().filename() == picture.filename())
            found.emplace(0, file);
        else if (const auto frame = frame_of(picture, output))
            found.emplace(*frame, file);
    }
    std::vector<fs::path> files;
    for (const auto& [frame, file] : found)
        files.push_back(file);
    return files;
}

void remove_states(const OutputName& output) {
    std::error_code ignored;
    for (const fs::path& file : find_states(output))
        fs::remove(file, ignored);
}

std::optional<SavedState> read_state(const fs::path& file,
                                     const std::function<Fingerprint(int frame)>& fingerprint_of,
                                     uint64_t most_bytes) {
    try {
        std::string line(k_longest_header, '\0');
        if (!std::ifstream(file, std::ios::binary).getline(line.data(), std::streamsize(line.size())))
            return std::nullopt;
        line.resize(std::strlen(line.c_str()));
        const Json header = parse_json(line);
        const auto size = size_of(header, line.size() + 1);
        if (header.at("tidemark_state") != k_version_of_format ||
            header.at("fingerprint") != fingerprint_of(header.at("frame").get<int>()).text() ||
            size > most_bytes || size != fs::file_size(file))
            return std::nullopt;
        const auto bytes = read_file(file, size);
        const auto content = bytes ? without_checksum(*bytes) : std::nullopt;
        return content && content->starts_with(line) ? parse(header, content->substr(line.size() + 1))
                                                     : std::nullopt;
    } catch (const Json::exception&) { // another program's file
        return std::nullopt;
    } catch (const fs::filesystem_error&) { // the file was removed
        return std::nullopt;
    }
}

Result<void> StateSaver::save_program() {
    const int first = renderer_.plan().feedback ? 0 : plan_.frames.frames.front();
    return save({first, renderer_.specialised()});
}

bool StateSaver::is_due(int frame) const {
    if (plan_.options.run.state_every == 0 || !renderer_.plan().feedback || frame <= last_.value_or(0))
        return false;
    if (!plan_.output.video())
        return frame % plan_.options.run.state_every == 0;
    return std::ranges::any_of(plan_.video.segments, [&](const VideoSegment& segment) {
        return segment.is_to_be_made() && segment.frames.front() == frame;
    });
}

Result<void> StateSaver::save_buffers(int frame) {
    return save({frame, renderer_.specialised(), renderer_.buffer_state()});
}

Result<void> StateSaver::save(const SavedState& state) {
    const OutputPath file = state_file(plan_.output, state.frame);
    auto written = write_state(file, state, plan_.identity_of(state.frame));
    if (!written)
        return written;
    if (last_)
        if (const OutputPath before = state_file(plan_.output, *last_); before.path() != file.path()) {
            std::error_code ignored;
            std::filesystem::remove(before.path(), ignored);
        }
    last_ = state.frame;
    return {};
}

std::vector<VideoSegment> segments_of(const std::vector<int>& frames, const VideoPace& pace, int length) {
    const auto step = std::ptrdiff_t(length > 0 ? length : k_default_length);
    std::vector<VideoSegment> segments;
    const std::vector<int> ticks = ticks_of(frames, pace);
    for (auto first = frames.begin(); first != frames.end();) {
        const auto end = first + std::min(step, frames.end() - first);
        const auto ticks_from = ticks.begin() + (first - frames.begin());
        segments.push_back({{first, end}, {ticks_from, ticks_from + (end - first)}});
        first = end;
    }
    return segments;
}

OutputPath segment_file(const OutputName& video, size_t index) {
    return video.of_frame(0).beside(
        fmt::format(".segment-{:04}{}", index, image::segment_extension(video.pattern())));
}

std::string note_of(const CapturePlan& plan, const VideoSegment& segment) {
    std::vector<render::FrameState> seen;
    for (const int frame : segment.frames)
        seen.push_back(plan.states(frame));
    return plan.identity.of_frames(seen).text();
}

Result<SegmentedVideo> SegmentedVideo::create(const CapturePlan& plan, Extent extent) {
    SegmentedVideo video(plan, extent);
    TRY(video.claim());
    TRY(video.open_next());
    return video;
}

/// Claims the video for this process. If two begin at the same moment, the one with the lower process ID goes
/// on. Waits for a killed process, which may take a moment to end, and for a program that it was starting.
Result<void> SegmentedVideo::claim() {
    constexpr std::chrono::milliseconds k_patience(1000), k_patience_with_ending(20000), k_pause(20);
    const OutputPath mark = plan_.output.of_frame(0).beside(
        plan_.shard ? fmt::format(".shard-{}", plan_.shard->index) : ".capture");
    const auto refuse = [&](pid_t other) {
        return fail(ErrorCode::write, fmt::format("cannot write '{}': process {} is writing it: wait until "
                                                  "that process ends, or give another name (-o)",
                                                  plan_.output.pattern().string(), other));
    };
    auto other = StagedFile::other_maker_of(mark);
    for (auto waited = k_pause; other && waited < (other->ends ? k_patience_with_ending : k_patience);
         waited += k_pause) {
        std::this_thread::sleep_for(k_pause);
        other = StagedFile::other_maker_of(mark);
    }
    if (other)
        return refuse(other->process);
    claim_.emplace(TRY(StagedFile::create(mark)));
    other = StagedFile::other_maker_of(mark);
    return other && other->process < ::getpid() ? refuse(other->process) : Result<void>();
}

Result<void> SegmentedVideo::open_next() {
    const std::vector<VideoSegment>& segments = plan_.video.segments;
    while (next_ < segments.size() && !segments[next_].is_to_be_made())
        ++next_;
    if (next_ == segments.size())
        return {};
    writer_.emplace(TRY(
        image::SegmentWriter::create(segment_file(plan_.output, next_), plan_.output.pattern(), format())));
    pushed_ = 0;
    ++next_;
    return {};
}

Result<void> SegmentedVideo::push(const image::Image& image) {
    if (!writer_)
        TRY(open_next());
    for (int tick = 0; tick < plan_.video.segments[next_ - 1].ticks[pushed_]; ++tick)
        TRY(writer_->push(image));
    return ++pushed_ < plan_.video.segments[next_ - 1].frames.size() ? Result<void>() : close();
}

Result<void> SegmentedVideo::close() {
    auto written = writer_->finish(note_of(plan_, plan_.video.segments[next_ - 1]));
    writer_.reset();
    if (written)
        written_ += pushed_;
    return written;
}

Result<void> SegmentedVideo::finish(const std::filesystem::path& sound) {
    std::vector<image::SegmentFile> files;
    for (size_t i = 0; i < plan_.video.segments.size(); ++i)
        files.push_back({segment_file(plan_.output, i).path(), ticks_in(plan_.video.segments[i])});
    TRY(image::join_segments(plan_.output.of_frame(0), files, format(), sound));
    remove_segments();
    return {};
}

Result<void> join(CapturePlan plan, const std::filesystem::path& sound) {
    for (VideoSegment& segment : plan.video.segments)
        segment.kept = true;
    SegmentedVideo video = TRY(SegmentedVideo::create(plan, plan.area.written));
    return video.finish(sound);
}

/// Also removes the segments of a longer, abandoned capture.
void SegmentedVideo::remove_segments() const {
    std::error_code ignored;
    for (size_t i = 0; std::filesystem::remove(segment_file(plan_.output, i).path(), ignored); ++i) {
    }
    StagedFile::remove_abandoned(segment_file(plan_.output, 0));
}

void note(std::vector<Wrong>& all, std::string what, const std::string& file) {
    const auto known = std::ranges::find(all, what, &Wrong::what);
    if (known != all.end())
        ++known->count;
    else
        all.push_back({std::move(what), file, 1});
}

std::vector<fs::path> files_of(const OutputName& output, int frame) {
    if (!output.six_faces())
        return {output.of_frame(frame).path()};
    std::vector<fs::path> files;
    for (size_t face = 0; face < 6; ++face)
        files.push_back(output.of_face(frame, face).path());
    return files;
}

KeptFrames leave_out_kept(CapturePlan& plan) {
    return plan.output.video() ? leave_out_segments(plan) : leave_out_pictures(plan);
}

} // namespace tidemark::cli
