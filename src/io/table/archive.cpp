#include "io/table/archive.hpp"

#include <fmt/format.h>
#include <zip.h>
#include <algorithm>
#include <array>

namespace corpuscle {
namespace {

constexpr std::uint16_t first_of_1980 = 1 << 5 | 1;  // month and day: 1980-01-01 is the earliest date of the zip format

struct CloseFile {
    void operator()(zip_file_t* f) const { zip_fclose(f); }
};

/// The uncompressed bytes of one member of an archive.
class MemberBytes final : public SeekableBytes {
    std::shared_ptr<zip> zip_;
    std::uint64_t index_;   // of the member in the archive
    std::uint64_t size_;    // uncompressed, in bytes
    std::uint64_t at_ = 0;  // position of the next byte to read
    std::string name_;      // for messages
    std::unique_ptr<zip_file_t, CloseFile> file_;

    Error read_error(zip_error_t* error) const {
        return bad_input(fmt::format("cannot be decompressed: {}", zip_error_strerror(error)), {name_});
    }

    /// Reads and discards `count` bytes.
    Result<void> skip(std::uint64_t count) {
        for (std::array<std::byte, 1 << 16> skipped; count > 0;) {
            const auto count_now = std::min<std::uint64_t>(count, skipped.size());
            TRY(read(std::span(skipped).first(static_cast<std::size_t>(count_now))));
            count -= count_now;
        }
        return {};
    }

public:
    MemberBytes(std::shared_ptr<zip> archive, std::uint64_t index, std::uint64_t size, std::string name)
        : zip_(std::move(archive)), index_(index), size_(size), name_(std::move(name)) {}

    /// Opens the member at its beginning, again if it was open.
    Result<void> open() {
        file_.reset();
        file_.reset(zip_fopen_index(zip_.get(), index_, 0));
        at_ = 0;
        return file_ ? Result<void>() : read_error(zip_get_error(zip_.get()));
    }

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return size_; }

    Result<void> read(std::span<std::byte> out) override {
        while (!out.empty()) {
            const auto got = zip_fread(file_.get(), out.data(), out.size());
            if (got < 0) return read_error(zip_file_get_error(file_.get()));
            if (got == 0) return bad_input("the file is incomplete", {name_});
            at_ += static_cast<std::uint64_t>(got);
            out = out.subspan(static_cast<std::size_t>(got));
        }
        if (at_ != size_) return {};
        std::byte beyond;  // reading past the end makes libzip verify the member's checksum
        const auto more = zip_fread(file_.get(), &beyond, 1);
        if (more < 0) return read_error(zip_file_get_error(file_.get()));
        if (more > 0)
            return bad_input(fmt::format("is longer than the {} bytes stated in the archive's directory; it may be damaged", size_),
                             {name_});
        return {};
    }

    Result<void> seek(std::uint64_t at) override {
        if (at == at_) return {};
        if (zip_fseek(file_.get(), static_cast<zip_int64_t>(at), SEEK_SET) == 0) return at_ = at, Result<void>{};
        // libzip cannot seek in a compressed member: read on to the position, if it is behind from the beginning.
        if (at < at_) TRY(open());
        return skip(at - at_);
    }
};

}  // namespace

bool Archive::is_supported() { return true; }

Result<Archive> Archive::open(const std::string& path) {
    TRY(open_bytes(path));  // its messages are clearer than those of libzip
    int code = 0;
    Archive archive;
    archive.path_ = path;
    archive.zip_ = std::shared_ptr<zip>(zip_open(path.c_str(), ZIP_RDONLY, &code), [](zip* z) { z ? zip_discard(z) : void(); });
    if (!archive.zip_) {
        zip_error_t error;
        zip_error_init_with_code(&error, code);
        const auto failure = bad_input(fmt::format("cannot be read as a zip archive: {}", zip_error_strerror(&error)), {path});
        zip_error_fini(&error);
        return failure;
    }
    const auto count = zip_get_num_entries(archive.zip_.get(), 0);
    for (zip_int64_t k = 0; k < count; ++k) {
        zip_stat_t about;
        if (zip_stat_index(archive.zip_.get(), static_cast<zip_uint64_t>(k), 0, &about) != 0 || !(about.valid & ZIP_STAT_SIZE))
            return bad_input(fmt::format("member {} of the archive cannot be read", k + 1), {path});
        archive.members_.push_back({about.name, about.size});
    }
    return archive;
}

Result<std::unique_ptr<SeekableBytes>> Archive::bytes(std::size_t member, std::string name) const {
    auto bytes = std::make_unique<MemberBytes>(zip_, member, members_[member].size, std::move(name));
    TRY(bytes->open());
    return std::unique_ptr<SeekableBytes>(std::move(bytes));
}

Result<std::string> make_archive(const std::vector<ArchiveEntry>& members) {
    zip_error_t error;
    zip_error_init(&error);
    const auto failed = [](zip_error_t* cause) {
        auto result = bad_input(fmt::format("the archive cannot be created: {}", zip_error_strerror(cause)));
        zip_error_fini(cause);
        return result;
    };
    zip_source_t* buffer = zip_source_buffer_create(nullptr, 0, 0, &error);
    zip* archive = buffer ? zip_open_from_source(buffer, ZIP_CREATE | ZIP_TRUNCATE, &error) : nullptr;
    if (!archive) return zip_source_free(buffer), failed(&error);
    zip_source_keep(buffer);  // a reference of our own: zip_close() and zip_discard() release one
    const auto discard = [&] {
        auto failure = bad_input(fmt::format("the archive cannot be created: {}", zip_strerror(archive)));
        zip_discard(archive), zip_source_free(buffer);
        return failure;
    };
    for (const auto& m : members) {
        zip_source_t* bytes = zip_source_buffer(archive, m.bytes.data(), m.bytes.size(), 0);
        const auto at = bytes ? zip_file_add(archive, m.name.c_str(), bytes, ZIP_FL_ENC_UTF_8) : -1;
        if (at < 0) return zip_source_free(bytes), discard();
        const auto index = static_cast<zip_uint64_t>(at);
        if (zip_set_file_compression(archive, index, ZIP_CM_STORE, 0) != 0 ||
            zip_file_set_dostime(archive, index, 0, first_of_1980, 0) != 0)
            return discard();
    }
    if (zip_close(archive) != 0) return discard();
    std::string out;
    if (zip_stat_t about; zip_source_stat(buffer, &about) == 0 && zip_source_open(buffer) == 0) {
        out.resize(about.size);
        const auto got = zip_source_read(buffer, out.data(), out.size());
        out.resize(static_cast<std::size_t>(std::max<zip_int64_t>(got, 0)));
        zip_source_close(buffer);
    }
    zip_source_free(buffer);
    return out;
}

}  // namespace corpuscle
