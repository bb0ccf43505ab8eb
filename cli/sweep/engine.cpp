#include "cli/sweep/engine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <span>
#include <thread>
#include <utility>

#include "cli/options/list.hpp"
#include "cli/options/long_work.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

/// Target run time of a block, if the number of rows allows it.
constexpr double kShortBlock_s = 0.02, kLongBlock_s = 0.1;
constexpr std::uint64_t kMostBlockRows = 8192, kFirstUnits = 16;
/// Blocks per thread that may be waiting to be written.
constexpr std::size_t kBlocksAhead = 4;
/// Units sampled to estimate the cost of shards.
constexpr std::uint64_t kCostSamples = 4096;
constexpr double kMostUnits = 1e18;

/// Appends the values of varied columns that precede every row.
class LeadingColumns {
public:
    LeadingColumns(const SweepSpace& space, const std::vector<std::size_t>& columns)
        : space_(space), columns_(columns), last_(columns.size(), kNone) {
        for (const std::size_t c : columns_) {
            if (space_.columns()[c].is_text()) {
                records_.columns.push_back(
                    {space_.columns()[c].path, tables::Column::CodedTexts{}});
            } else {
                records_.columns.push_back(
                    {space_.columns()[c].path, tables::Column::CodedNumbers{}});
            }
        }
    }

    void add(std::uint64_t combination, std::size_t rows) {
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const std::size_t index = space_.at(columns_[i], combination);
            const SweptColumn& column = space_.columns()[columns_[i]];
            const bool is_new = index != last_[i];
            last_[i] = index;
            if (auto* texts =
                    std::get_if<tables::Column::CodedTexts>(&records_.columns[i].values)) {
                if (is_new) texts->values.push_back(column.texts[index]);
                append(*texts, rows);
            } else {
                auto& numbers = std::get<tables::Column::CodedNumbers>(records_.columns[i].values);
                if (is_new) numbers.values.push_back(column.number(index));
                append(numbers, rows);
            }
        }
    }

    tables::Records take() { return std::move(records_); }

private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    template <class Value>
    static void append(tables::Column::Coded<Value>& to, std::size_t rows) {
        to.codes.insert(to.codes.end(), rows, static_cast<std::uint32_t>(to.values.size() - 1));
    }

    const SweepSpace& space_;
    const std::vector<std::size_t>& columns_;
    std::vector<std::size_t> last_;
    tables::Records records_;
};

/// Length in bytes of the longest value of a column.
std::size_t width_of(const SweptColumn& column) {
    std::size_t width = 1;
    for (const std::string& text : column.texts) width = std::max(width, text.size());
    return width;
}

tables::RecordField field_of(const SweptColumn& column) {
    if (column.is_text()) return {column.path, tables::RecordField::Type::text, width_of(column)};
    return {column.path};
}

bool has_field(std::span<const tables::RecordField> layout, const std::string& name) {
    return std::ranges::find(layout, name, &tables::RecordField::name) != layout.end();
}

/// Runs `work`; prefixes its errors with "at PLACE: ".
template <class Place, class Work>
auto at_place(const Place& place, const Work& work) {
    try {
        return work();
    } catch (const ToleranceError& error) {
        throw ToleranceError("at " + place() + ": " + error.what());
    } catch (const Error& error) {
        throw schemas::InputError("", "", "at " + place() + ": " + error.what());
    }
}

}  // namespace

/// Units computed by one thread.
struct SweepEngine::Block {
    std::uint64_t begin, end;
    std::string bytes = {};
    std::uint64_t rows = 0;
    std::exception_ptr failure = {};
    bool is_done = false;
};

/// Hands out blocks to threads and returns them in order.
class SweepEngine::Blocks {
public:
    Blocks(std::uint64_t begin, std::uint64_t end, std::uint64_t most_units, std::size_t ahead)
        : next_(begin), end_(end), most_units_(most_units), ahead_(ahead) {}

    /// The next block to compute; nullptr if there is none.
    std::shared_ptr<Block> take() {
        std::unique_lock guard(lock_);
        changed_.wait(guard, [&] { return stopped || next_ == end_ || waiting_.size() < ahead_; });
        if (stopped || next_ == end_) return nullptr;
        const std::uint64_t begin = next_;
        next_ = begin + std::min(units_, end_ - begin);
        waiting_.push_back(std::make_shared<Block>(Block{begin, next_}));
        return waiting_.back();
    }

    void give_back(Block& block, double seconds) {
        const std::scoped_lock guard(lock_);
        block.is_done = true;
        if (block.end - block.begin == units_) {
            if (seconds < kShortBlock_s) units_ = std::min(2 * units_, most_units_);
            if (seconds > kLongBlock_s) units_ = std::max<std::uint64_t>(1, units_ / 2);
        }
        changed_.notify_all();
    }

    /// The first unwritten block when it is done; nullptr after a short wait.
    std::shared_ptr<Block> first_done() {
        std::unique_lock guard(lock_);
        const auto is_done = [&] { return !waiting_.empty() && waiting_.front()->is_done; };
        if (!changed_.wait_for(guard, std::chrono::milliseconds(100), is_done)) return nullptr;
        const std::shared_ptr<Block> block = std::move(waiting_.front());
        waiting_.pop_front();
        changed_.notify_all();
        return block;
    }

    void stop() {
        const std::scoped_lock guard(lock_);
        stopped = true;
        changed_.notify_all();
    }

    std::atomic<bool> stopped{false};

private:
    std::mutex lock_;
    std::condition_variable changed_;
    std::uint64_t next_, end_, most_units_, units_ = std::min(kFirstUnits, most_units_);
    std::size_t ahead_;
    std::deque<std::shared_ptr<Block>> waiting_;
};

SweepEngine::SweepEngine(SweptStacks& stacks, const SweepSpace& space, const Query& query,
                         bool keep_going)
    : stacks_(stacks), space_(space), query_(query), keep_going_(keep_going) {
    const auto& columns = space.columns();
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (!columns[c].is_light()) led_by_.push_back(c);
        if (columns[c].path == kSweptAngle) angle_column_ = c;
        if (columns[c].path == kSweptWavelength) wavelength_column_ = c;
    }
    if (wavelength_column_ && !query.takes_wavelength())
        throw UsageError("wavelength_nm: can vary for --compute spectrum only");
    units_ = space.size();
    is_inner_angle_ = angle_column_ && *angle_column_ + 1 == columns.size() &&
                      !columns.back().of_points && query.splits_angles();
    static constexpr double kNoAngle = 0;  // set by the combination
    if (is_inner_angle_) {
        angles_ = columns.back().numbers;
        angle_column_.reset();
    } else if (angle_column_ || !query.splits_angles()) {
        angles_ = {&kNoAngle, 1};
    } else {
        angles_ = query.angles_deg();
        if (static_cast<double>(units_) * static_cast<double>(angles_.size()) > kMostUnits)
            throw UsageError("--vary: must give at most 1e18 combinations and angles");
        units_ *= angles_.size();
    }
    rows_per_unit_ = query.rows_per_angle();
    if (!angle_column_ && !query.splits_angles()) rows_per_unit_ *= query.angles_deg().size();
    const tables::RecordLayout computed = query.layout(stacks_.first());
    for (const SweptColumn& column : columns) layout_.push_back(field_of(column));
    const std::size_t varied = layout_.size();
    for (const tables::RecordField& field : computed)
        if (!has_field(std::span(layout_).first(varied), field.name)) layout_.push_back(field);
}

double SweepEngine::cost_us(std::uint64_t unit, SweptStacks::Walk& walk) const {
    const std::uint64_t combination = combination_of(unit);
    constexpr double kLeftOut = 1;
    std::optional<double> wavelength_nm;
    if (wavelength_column_) wavelength_nm = number_at(*wavelength_column_, combination);
    try {
        const auto& place = walk.at(combination);
        const auto cost = [&](double angle_deg) {
            return query_.cost_us(*place.prepared, place.stack, angle_deg, wavelength_nm);
        };
        if (angle_column_) return cost(number_at(*angle_column_, combination));
        if (query_.splits_angles()) return cost(angles_[unit % angles_.size()]);
        return cost(0) * static_cast<double>(query_.angles_deg().size());
    } catch (const Error&) {  // the run will report it
        return kLeftOut;
    }
}

std::vector<std::uint64_t> SweepEngine::shard_ends(std::uint64_t shards) {
    constexpr double kRounded = 64;  // sums of whole numbers are the same on every machine
    const std::uint64_t cells = std::min(units_, kCostSamples);
    const auto cell_begin = [&](std::uint64_t cell) {
        return static_cast<std::uint64_t>(static_cast<long double>(units_) *
                                          static_cast<long double>(cell) /
                                          static_cast<long double>(cells));
    };
    SweptStacks::Walk walk(stacks_);
    std::vector<double> sums{0};
    for (std::uint64_t cell = 0; cell < cells; ++cell) {
        const std::uint64_t begin = cell_begin(cell), end = cell_begin(cell + 1);
        const double cost = std::round(kRounded * cost_us(begin + (end - begin) / 2, walk));
        sums.push_back(sums.back() + cost * static_cast<double>(end - begin));
    }
    std::vector<std::uint64_t> ends{0};
    for (std::uint64_t shard = 1; shard < shards; ++shard) {
        const double aim = sums.back() * static_cast<double>(shard) / static_cast<double>(shards);
        const auto after = std::ranges::upper_bound(sums, aim);
        const auto cell = static_cast<std::uint64_t>(after - sums.begin()) - 1;
        const std::uint64_t begin = cell_begin(cell), end = cell_begin(cell + 1);
        const double part = (aim - sums[cell]) / (sums[cell + 1] - sums[cell]);
        ends.push_back(begin + static_cast<std::uint64_t>(
                                   std::round(part * static_cast<double>(end - begin))));
    }
    ends.push_back(units_);
    return ends;
}

std::size_t SweepEngine::add(std::uint64_t unit, std::size_t count, SweptStacks::Walk& walk,
                             QueryResult& result) {
    const std::uint64_t combination = combination_of(unit);
    double angle_deg = 0;
    Incidence incidence;
    if (angle_column_) {
        angle_deg = number_at(*angle_column_, combination);
        incidence.angles_deg = {&angle_deg, 1};
    } else if (query_.splits_angles()) {
        incidence.angles_deg = angles_.subspan(unit % angles_.size(), count);
    } else {
        incidence.angles_deg = query_.angles_deg();
    }
    if (wavelength_column_) incidence.wavelength_nm = number_at(*wavelength_column_, combination);
    const auto work = [&] {
        const auto& place = walk.at(combination);
        return result.add(*place.prepared, place.stack, incidence);
    };
    const auto place = [&] {
        const bool names_angle = !is_inner_angle_ && angles_.size() > 1;
        return space_.describe(combination) +
               (names_angle ? ", angle_deg=" + to_text(incidence.angles_deg.front()) : "");
    };
    return at_place(place, work);
}

tables::Records SweepEngine::assembled(tables::Records leading, tables::Records computed) const {
    tables::Records all;
    for (tables::Column& column : leading.columns) all.columns.push_back(std::move(column));
    const auto move_here = [&](const std::string& name) {
        const auto found = std::ranges::find(computed.columns, name, &tables::Column::name);
        all.columns.push_back(std::move(*found));
        computed.columns.erase(found);
    };
    for (std::size_t c = 0; c < space_.columns().size(); ++c) {
        if (!space_.columns()[c].is_light()) continue;
        move_here(space_.columns()[c].path);
        std::rotate(all.columns.begin() + static_cast<std::ptrdiff_t>(c), all.columns.end() - 1,
                    all.columns.end());
    }
    for (tables::Column& column : computed.columns) all.columns.push_back(std::move(column));
    if (all.columns.size() != layout_.size())
        throw UsageError(
            "--columns: A_layers requires the same number of layers in every stack of a sweep");
    return all;
}

void SweepEngine::take_alone(std::uint64_t unit, const std::function<void()>& take) {
    if (!keep_going_) return take();
    try {
        take();
    } catch (const Error& error) {
        const std::scoped_lock guard(left_out_lock_);
        ++counts_.left_out;
        if (unit > first_left_out_unit_) return;
        first_left_out_unit_ = unit;
        first_left_out_ = error.what();
    }
}

void SweepEngine::compute(Block& block, SweptStacks::Walk& walk, const tables::RecordFormat& format,
                          const std::atomic<bool>& stopped) {
    LeadingColumns leading(space_, led_by_);
    const std::unique_ptr<QueryResult> result = query_.new_result();
    const auto take = [&](std::uint64_t unit, std::uint64_t count) {
        const std::size_t rows = add(unit, count, walk, *result);
        leading.add(combination_of(unit), rows);
        block.rows += rows;
        ++counts_.stacks;
    };
    for (std::uint64_t unit = block.begin; unit < block.end && !stopped;) {
        const std::uint64_t of_combination = angles_.size() - unit % angles_.size();
        const std::uint64_t count = std::min(of_combination, block.end - unit);
        try {
            take(unit, count);
        } catch (const Error&) {  // one of its units
            for (std::uint64_t i = 0; i < count; ++i)
                take_alone(unit + i, [&] { take(unit + i, 1); });
        }
        unit += count;
    }
    if (block.rows > 0)
        block.bytes = format.rows(layout_, assembled(leading.take(), result->records()));
}

double SweepEngine::try_units(std::uint64_t first, double units) {
    SweptStacks::Walk walk(stacks_);
    if (units >= 1) {
        const auto count = static_cast<std::uint64_t>(units);
        const std::unique_ptr<QueryResult> result = query_.new_result();
        for (std::uint64_t i = 0; i < count; ++i) add(first + i, 1, walk, *result);
        return static_cast<double>(count);
    }
    const std::uint64_t combination = combination_of(first);
    const auto& place = walk.at(combination);
    schemas::StackDocument document = place.prepared->document;
    document.stack = place.stack;
    double angle_deg = angles_[first % angles_.size()];
    if (angle_column_) angle_deg = number_at(*angle_column_, combination);
    Incidence incidence{{&angle_deg, 1}};
    if (!angle_column_ && !query_.splits_angles()) incidence.angles_deg = query_.angles_deg();
    if (wavelength_column_) incidence.wavelength_nm = number_at(*wavelength_column_, combination);
    return query_.try_share(document, incidence, units);
}

double SweepEngine::seconds_of(std::uint64_t begin, std::uint64_t end, unsigned threads) {
    const auto seconds = [&](double units) {
        double tried = units;
        const double taken =
            processor_seconds([&] { tried = try_units(begin + (end - begin) / 2, units); });
        return taken * units / tried / threads_used(threads);
    };
    return tried_seconds(static_cast<double>(end - begin), kFirstShare, seconds);
}

bool SweepEngine::run(std::uint64_t begin, std::uint64_t end, const tables::RecordFormat& format,
                      tables::RecordStream& stream, unsigned threads,
                      const std::function<bool(std::uint64_t)>& proceed) {
    threads = threads_used(threads);
    const std::uint64_t rows = std::max<std::uint64_t>(1, rows_per_unit_);
    Blocks blocks(begin, end, std::clamp<std::uint64_t>(kMostBlockRows / rows, 1, kMostBlockRows),
                  kBlocksAhead * threads);
    const auto work = [&] {
        SweptStacks::Walk walk(stacks_);
        while (const std::shared_ptr<Block> block = blocks.take()) {
            const auto start = std::chrono::steady_clock::now();
            try {
                compute(*block, walk, format, blocks.stopped);
            } catch (...) {
                block->failure = std::current_exception();
            }
            blocks.give_back(
                *block,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
    };
    std::vector<std::jthread> workers;
    struct Stopping {  // before the threads are joined, however this ends
        Blocks& blocks;
        ~Stopping() { blocks.stop(); }
    } stopping{blocks};
    for (unsigned i = 0; i < threads; ++i) workers.emplace_back(work);
    for (std::uint64_t written = begin; written < end;) {
        if (!proceed(written - begin)) return false;
        const std::shared_ptr<Block> block = blocks.first_done();
        if (!block) continue;
        if (block->failure) std::rethrow_exception(block->failure);
        stream.append(block->bytes, block->end - block->begin, block->rows);
        counts_.rows += block->rows;
        written = block->end;
    }
    return true;
}

}  // namespace irido::cli
