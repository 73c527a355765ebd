#include "media/sound_file.hpp"
#include "unit/media/sound_support.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <vector>

namespace tidemark::sound::sound_file_test {

using testing::HasSubstr;

class SoundFile : public SoundTest {
protected:
    std::string message_of(const fs::path& path) const {
        const Result<SoundData> sound = read_sound(path);
        return sound ? "no error" : sound.error().message;
    }
};

struct Kind {
    const char* name;
    int format;
    double error; ///< that its compression makes
};

constexpr Kind k_kinds[] = {
    {"a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1.0 / 32768.0},
    {"b.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 0.0},
    {"a.aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_24, 1.0 / 8388608.0},
    {"a.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 1.0 / 32768.0},
    {"a.ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 0.05},
    {"a.mp3", SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III, 0.05},
};

TEST_F(SoundFile, every_kind_is_decoded_at_its_own_rate) {
    for (const Kind& kind : k_kinds) {
        const SoundData sine_wave = sine(441.0, 0.5, 0.5, 48000, 2);
        const Result<SoundData> sound =
            read_sound(write_encoded(in_folder(kind.name), sine_wave, kind.format));
        ASSERT_TRUE(sound) << sound.error().message;
        EXPECT_EQ(sound->rate, 48000) << kind.name;
        EXPECT_EQ(sound->channels, 2) << kind.name;
        EXPECT_NEAR(sound->duration(), 0.5, 0.06) << kind.name;
        for (size_t i = 4800; i < 38400; ++i)
            ASSERT_NEAR(sound->samples[i], sine_wave.samples[i], kind.error) << kind.name << ' ' << i;
    }
}

TEST_F(SoundFile, written_wav_is_read_back_bit_by_bit) {
    std::mt19937 random(3);
    std::vector<int16_t> samples = {-32768, 32767, 0, -1};
    while (samples.size() < 20000)
        samples.push_back(int16_t(random()));
    ASSERT_TRUE(write_wav(in_folder("w.wav"), 44100, samples));
    const Result<SoundData> sound = read_sound(in_folder("w.wav"));
    ASSERT_TRUE(sound) << sound.error().message;
    EXPECT_EQ(sound->rate, 44100);
    EXPECT_EQ(sound->channels, 2);
    ASSERT_EQ(sound->samples.size(), samples.size());
    for (size_t i = 0; i < samples.size(); ++i)
        ASSERT_EQ(sound->samples[i], float(samples[i]) / 32768.0f);
}

TEST_F(SoundFile, wav_has_the_header_of_pcm) {
    ASSERT_TRUE(write_wav(in_folder("w.wav"), 48000, std::vector<int16_t>{1, -2, 0x1234, 0}));
    using namespace std::string_literals;
    EXPECT_EQ(bytes_of(in_folder("w.wav")),
              "RIFF\x2c\0\0\0WAVEfmt \x10\0\0\0\1\0\2\0\x80\xbb\0\0\0\xee\2\0\4\0\x10\0"
              "data\x8\0\0\0\1\0\xfe\xff\x34\x12\0\0"s);
}

TEST_F(SoundFile, an_empty_wav_is_written_and_has_no_sound) {
    ASSERT_TRUE(write_wav(in_folder("w.wav"), 44100, {}));
    EXPECT_EQ(bytes_of(in_folder("w.wav")).size(), 44u);
    EXPECT_THAT(message_of(in_folder("w.wav")), HasSubstr("there is no sound in it"));
}

TEST_F(SoundFile, an_unwritable_wav_is_an_error) {
    const Result<void> written = write_wav(in_folder("none") / "w.wav", 44100, {});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::write);
    EXPECT_THAT(written.error().message, HasSubstr("No such file or directory"));
}

TEST_F(SoundFile, truncated_files_are_refused) {
    for (const Kind& kind : k_kinds) {
        const std::string whole =
            bytes_of(write_encoded(in_folder(kind.name), sine(441.0, 0.5, 0.2), kind.format));
        EXPECT_EQ(message_of(in_folder(kind.name)), "no error");
        for (size_t i = 0; i < 131; ++i) {
            const size_t length = i < 30 ? i * 4 : i < 130 ? whole.size() * (i - 30) / 100 : whole.size() - 1;
            EXPECT_THAT(message_of(put(kind.name, whole.substr(0, length))),
                        HasSubstr("cannot read '" + in_folder(kind.name).string()))
                << kind.name << " cut to " << length << " of " << whole.size();
        }
        EXPECT_THAT(message_of(put(kind.name, whole.substr(0, whole.size() * 3 / 4))),
                    HasSubstr(": the file is damaged or cut short"));
    }
}

TEST_F(SoundFile, a_wav_from_a_pipe_is_read_to_its_end) {
    std::string wav = bytes_of(write_encoded(in_folder("p.wav"), sine(441.0, 0.5, 0.2), k_kinds[0].format));
    const size_t frames = read_sound(in_folder("p.wav"))->frames();
    wav.replace(4, 4, "\xff\xff\xff\xff");
    wav.replace(wav.find("data") + 4, 4, "\xff\xff\xff\xff");
    const Result<SoundData> sound = read_sound(put("p.wav", wav));
    ASSERT_TRUE(sound) << sound.error().message;
    EXPECT_EQ(sound->frames(), frames);
}

TEST_F(SoundFile, damaged_files_do_not_crash) {
    std::mt19937 random(5);
    for (const Kind& kind : k_kinds) {
        const std::string whole =
            bytes_of(write_encoded(in_folder(kind.name), sine(441.0, 0.5, 0.1), kind.format));
        for (int i = 0; i < 60; ++i) {
            std::string damaged = whole;
            for (int changes = 0; changes < 8; ++changes)
                damaged[random() % (i % 2 == 0 ? std::min<size_t>(200, whole.size()) : whole.size())] =
                    char(random());
            if (const Result<SoundData> sound = read_sound(put(kind.name, damaged))) {
                EXPECT_GT(sound->frames(), 0u);
            }
        }
    }
}

TEST_F(SoundFile, errors_are_reported) {
    const auto in = [&](const std::string& name) { return "'" + in_folder(name).string() + "'"; };
    EXPECT_EQ(message_of(in_folder("none.ogg")), "cannot read " + in("none.ogg") + ": no such file");
    EXPECT_EQ(message_of(in_folder("")), "cannot read " + in("") + ": it is a directory");
    EXPECT_EQ(message_of(put("e.wav", "")), "cannot read " + in("e.wav") + ": the file is empty");
    EXPECT_THAT(message_of(put("t.wav", "not a sound at all, only text\n")),
                HasSubstr("cannot read " + in("t.wav") +
                          ": it is damaged, or not a WAV, AIFF, FLAC, Ogg or MP3 sound ("));
    const fs::path fast = write_encoded(in_folder("f.wav"), SoundData{500000, 1, std::vector<float>(10)},
                                        SF_FORMAT_WAV | SF_FORMAT_PCM_16);
    EXPECT_EQ(message_of(fast),
              "cannot read " + in("f.wav") + ": its rate is 500000 Hz; rates from 1000 to 384000 are read");
    const fs::path many = write_encoded(in_folder("m.wav"), SoundData{44100, 9, std::vector<float>(90)},
                                        SF_FORMAT_WAV | SF_FORMAT_PCM_16);
    EXPECT_EQ(message_of(many), "cannot read " + in("m.wav") + ": it has 9 channels; the limit is 8");
    const fs::path lengthy =
        write_encoded(in_folder("l.wav"), SoundData{1000, 1, std::vector<float>(1200 * 1000 + 1)},
                      SF_FORMAT_WAV | SF_FORMAT_PCM_U8);
    EXPECT_EQ(message_of(lengthy), "cannot read " + in("l.wav") + ": it is longer than 20 minutes");
}

} // namespace tidemark::sound::sound_file_test
