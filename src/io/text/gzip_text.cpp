#include "io/text/gzip_text.hpp"

#include <zlib.h>

namespace corpuscle {
namespace {

constexpr std::size_t packed_block = std::size_t{1} << 17;  // compressed bytes that are read at once

class GzipText final : public TextInput {
    std::string path_;
    std::unique_ptr<TextInput> packed_;                                            // the compressed file
    std::vector<unsigned char> block_ = std::vector<unsigned char>(packed_block);  // compressed bytes
    z_stream stream_{};
    bool within_ = false;        // true inside a member
    bool packed_ended_ = false;  // true after the last compressed byte was read

    Result<void> refill() {
        const auto got = TRY(packed_->read(reinterpret_cast<char*>(block_.data()), block_.size()));
        packed_ended_ = got < block_.size();
        stream_.next_in = block_.data(), stream_.avail_in = static_cast<uInt>(got);
        return {};
    }

    /// Skips zeros between and after members: files from tapes are padded with them.
    void skip_zeros() {
        while (stream_.avail_in > 0 && *stream_.next_in == 0) ++stream_.next_in, --stream_.avail_in;
    }

    Result<std::size_t> fetch(char* to, std::size_t max_bytes) override {
        stream_.next_out = reinterpret_cast<Bytef*>(to), stream_.avail_out = static_cast<uInt>(max_bytes);
        while (stream_.avail_out > 0) {
            if (stream_.avail_in == 0 && !packed_ended_) TRY(refill());
            if (!within_) skip_zeros();
            if (stream_.avail_in == 0 && packed_ended_) {
                if (within_) return bad_input("this gzip file is incomplete", {path_});
                break;
            }
            if (stream_.avail_in == 0) continue;
            within_ = true;
            const int status = ::inflate(&stream_, Z_NO_FLUSH);
            if (status == Z_STREAM_END)
                within_ = false, ::inflateReset(&stream_);  // another member may follow, as written by 'cat a.gz b.gz'
            else if (status != Z_OK && status != Z_BUF_ERROR)
                return bad_input("this gzip file is damaged: it cannot be decompressed", {path_});
        }
        return max_bytes - stream_.avail_out;
    }

    Result<void> restart() override {
        ::inflateReset(&stream_);
        stream_.avail_in = 0;
        within_ = packed_ended_ = false;
        return packed_->rewind();
    }

public:
    GzipText(std::string path, std::unique_ptr<TextInput> packed) : path_(std::move(path)), packed_(std::move(packed)) {
        ::inflateInit2(&stream_, 15 + 16);  // 15: the largest window; 16: gzip, not zlib, format
    }
    GzipText(const GzipText&) = delete;
    GzipText& operator=(const GzipText&) = delete;
    ~GzipText() override { ::inflateEnd(&stream_); }
    double progress() const override { return packed_->progress(); }
    std::vector<std::string> shell_commands() const override { return {"zcat"}; }
};

}  // namespace

std::unique_ptr<TextInput> make_gzip_text(std::string path, std::unique_ptr<TextInput> packed) {
    return std::make_unique<GzipText>(std::move(path), std::move(packed));
}

}  // namespace corpuscle
