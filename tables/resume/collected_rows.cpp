#include "tables/resume/collected_rows.hpp"

#include <utility>

#include "tables/records/packed_rows.hpp"

namespace irido::tables {

namespace {

class CollectedRows : public RecordStream {
public:
    CollectedRows(RecordLayout layout, std::function<void(Records)> take)
        : layout_(std::move(layout)), take_(std::move(take)) {}

    std::uint64_t units_done() const override { return 0; }
    std::uint64_t rows_done() const override { return rows_; }
    bool is_complete() const override { return false; }
    void append(const std::string& bytes, std::uint64_t, std::uint64_t rows) override {
        bytes_ += bytes;
        rows_ += rows;
    }
    void finish() override {
        const std::string bytes = std::exchange(bytes_, {});
        take_(unpacked_rows(layout_, bytes));
    }
    void suspend() override { discard(); }
    void discard() noexcept override { bytes_.clear(); }

private:
    RecordLayout layout_;
    std::function<void(Records)> take_;
    std::string bytes_;
    std::uint64_t rows_ = 0;
};

std::string no_head(const RecordLayout&, std::uint64_t, HeadKind) {
    return "";
}

std::string packed(const RecordLayout& layout, const Records& records) {
    return packed_rows(layout, records, TextCode::utf8);
}

}  // namespace

const RecordFormat& packed_format() {
    static constexpr RecordFormat format{.name = "packed",
                                         .summary = "rows in memory",
                                         .is_binary = true,
                                         .separator = "",
                                         .head = no_head,
                                         .rows = packed,
                                         .tail = ""};
    return format;
}

std::unique_ptr<RecordStream> collected_rows(const RecordLayout& layout,
                                             std::function<void(Records)> take) {
    return std::make_unique<CollectedRows>(layout, std::move(take));
}

}  // namespace irido::tables
