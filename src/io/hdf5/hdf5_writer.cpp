#include "io/hdf5/hdf5_writer.hpp"

#include "io/sandbox/helper_messages.hpp"

namespace corpuscle {

void Hdf5Writer::send(const Hdf5Step& step) { helper_.send(encode_request(step)); }

Result<Hdf5Writer> Hdf5Writer::start(OutputFile& file) { return start(::fileno(file.stream()), file.path()); }

Result<Hdf5Writer> Hdf5Writer::start(int descriptor, const std::string& path) {
    const auto program = find_helper_program("corpuscle-hdf5");
    if (!program) return bad_input(program.error().message, {path});
    auto helper = HelperProcess::start(*program, descriptor, HelperProcess::writer_protocol);
    if (!helper) return bad_input(helper.error().message, {path});
    Hdf5Writer out;
    out.path_ = path, out.helper_ = *std::move(helper);
    return out;
}

void Hdf5Writer::add_group(const std::string& path, std::vector<Hdf5Attribute> attributes) {
    send({.kind = Hdf5Step::Kind::group, .path = path, .attributes = std::move(attributes)});
}

void Hdf5Writer::add_attributes(const std::string& path, std::vector<Hdf5Attribute> attributes) {
    send({.kind = Hdf5Step::Kind::attributes, .path = path, .attributes = std::move(attributes)});
}

void Hdf5Writer::add_texts(const std::string& path, std::vector<std::string> texts, bool is_scalar, std::vector<Hdf5Attribute> attributes) {
    std::vector<std::uint64_t> shape;
    if (!is_scalar) shape = {texts.size()};
    add_texts(path, std::move(texts), std::move(shape), std::move(attributes));
}

void Hdf5Writer::add_texts(const std::string& path, std::vector<std::string> texts, std::vector<std::uint64_t> shape,
                           std::vector<Hdf5Attribute> attributes) {
    send({.kind = Hdf5Step::Kind::dataset,
          .path = path,
          .type = Hdf5Type::text,
          .shape = std::move(shape),
          .attributes = std::move(attributes),
          .texts = std::move(texts)});
}

void Hdf5Writer::add_growing(const std::string& path, std::uint64_t columns, std::vector<Hdf5Attribute> attributes) {
    std::vector<std::uint64_t> shape = {0};
    if (columns > 0) shape.push_back(columns);
    send({.kind = Hdf5Step::Kind::dataset,
          .path = path,
          .shape = std::move(shape),
          .is_growing = true,
          .attributes = std::move(attributes)});
}

void Hdf5Writer::append(const std::string& path, std::span<const double> values) {
    const auto* at = reinterpret_cast<const char*>(values.data());
    send({.kind = Hdf5Step::Kind::append, .path = path, .bytes = {at, at + values.size_bytes()}});
}

Result<void> Hdf5Writer::finish() {
    send({.kind = Hdf5Step::Kind::finish});
    auto reply = helper_.receive(path_, "the HDF5 library");
    if (!reply && reply.error().code == ErrorCode::interrupted) return reply.error();
    if (!reply) return bad_input("could not be written: the program corpuscle-hdf5 ended before the file was complete", {path_});
    auto status = decode_status(*reply, path_);
    if (status) return {};
    Error error = status.error();
    error.location = {path_};
    return error;
}

}  // namespace corpuscle
