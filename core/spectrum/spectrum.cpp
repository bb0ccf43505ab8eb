#include "core/spectrum/spectrum.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "core/coherent/media.hpp"
#include "core/error.hpp"
#include "core/keep_once.hpp"
#include "core/math/parallel.hpp"

namespace irido {

namespace {

/// Points that one thread takes at a time.
constexpr std::size_t kPlainBlock = 64, kVectorBlock = 1024;

/// Fewer wavelengths than this go side by side with other angles.
constexpr std::size_t kFewWavelengths = 8;

/// The vector kernel's sine takes phases up to 2^40.
constexpr double kLargestPhase = 0x1p40;

/// Less work than this is not worth a second thread; its unit is about 0.1 us.
constexpr double kLittleWork = 1000, kPlainWork = 5, kVectorWork = 0.01;

/// Makes room for what is needed, keeping memory from before.
void allocate(Spectrum& spectrum, const Needs& needs, std::size_t points, std::size_t layers) {
    spectrum.R.resize(needs.R ? points : 0);
    spectrum.T.resize(needs.T ? points : 0);
    spectrum.A.resize(needs.A ? points : 0);
    spectrum.r.resize(needs.amplitudes ? points : 0);
    spectrum.t.resize(needs.amplitudes ? points : 0);
    for (const auto values :
         {&Spectrum::denominator_re, &Spectrum::denominator_im, &Spectrum::log_scale})
        (spectrum.*values).resize(needs.denominators ? points : 0);
    spectrum.A_layers.resize(needs.layers ? layers * points : 0);
}

void store(Spectrum& to, std::size_t point, const Response& response) {
    if (!to.R.empty()) to.R[point] = response.power.R;
    if (!to.T.empty()) to.T[point] = response.power.T;
    if (!to.A.empty()) to.A[point] = response.power.A;
    if (!to.r.empty()) {
        to.r[point] = response.r;
        to.t[point] = response.t;
    }
    if (!to.log_scale.empty()) {
        to.denominator_re[point] = response.denominator.real();
        to.denominator_im[point] = response.denominator.imag();
        to.log_scale[point] = response.log_scale;
    }
}

void store_layers(Spectrum& to, std::size_t point, std::span<const double> absorbed) {
    if (absorbed.empty()) return;
    const std::size_t points = to.A_layers.size() / absorbed.size();
    for (std::size_t layer = 0; layer < absorbed.size(); ++layer)
        to.A_layers[layer * points + point] = absorbed[layer];
}

[[noreturn]] void throw_no_means() {
    throw DomainError("the mean over thickness_sigma_nm is not known to the vector kernel");
}

/// Points by the plain kernel.
class PlainRun {
public:
    PlainRun(const StackPower& stack, const IndexTable& table, const Needs& needs, Spectra& out)
        : stack_(stack), table_(table), needs_(needs), out_(out) {}

    void operator()(IncidentAngle incidence, std::size_t wavelength, std::size_t point) {
        for_each_polarization(incidence, wavelength, point, true);
    }

    /// What each layer absorbs, and nothing else.
    void layers(IncidentAngle incidence, std::size_t wavelength, std::size_t point) {
        for_each_polarization(incidence, wavelength, point, false);
    }

private:
    void for_each_polarization(IncidentAngle incidence, std::size_t wavelength, std::size_t point,
                               bool powers) {
        wavelength_ = wavelength;
        incidence_ = incidence;
        absorbed_.resize(needs_.layers ? stack_.layer_count() : 0);
        const double k0 = table_.k0()[wavelength];
        Spectrum* const s = needs_.s ? &out_.s : nullptr;
        Spectrum* const p = needs_.p ? &out_.p : nullptr;
        if (incidence.cos == 1) {
            compute(Polarization::s, k0, point, powers, s ? s : p,
                    s && needs_.p_at_normal ? p : nullptr);
        } else {
            if (s) compute(Polarization::s, k0, point, powers, s, nullptr);
            if (p) compute(Polarization::p, k0, point, powers, p, nullptr);
        }
    }

    void compute(Polarization polarization, double k0, std::size_t point, bool powers, Spectrum* to,
                 Spectrum* also) {
        Response response;
        set_media(table_, wavelength_, incidence_, polarization, media_);
        try {
            if (powers) response = stack_(media_, k0, polarization, {needs_.T, needs_.A});
            if (needs_.layers) stack_.layer_absorption(media_, k0, polarization, absorbed_);
        } catch (const DomainError& error) {
            const double nm = table_.wavelength_nm()[point % table_.wavelength_nm().size()];
            throw DomainError(std::string(error.what()) + " (" + to_text(nm) + " nm, " +
                              (polarization == Polarization::s ? "s" : "p") + ")");
        }
        for (Spectrum* spectrum : {to, also}) {
            if (!spectrum) continue;
            if (powers) store(*spectrum, point, response);
            if (needs_.layers) store_layers(*spectrum, point, absorbed_);
        }
    }

    const StackPower& stack_;
    const IndexTable& table_;
    const Needs& needs_;
    Spectra& out_;
    std::size_t wavelength_ = 0;
    IncidentAngle incidence_{1};
    std::vector<Medium> media_;
    std::vector<double> absorbed_;
};

double* place(std::vector<double>& values, std::size_t point) {
    return values.empty() ? nullptr : values.data() + point;
}
Complex* place(std::vector<Complex>& values, std::size_t point) {
    return values.empty() ? nullptr : values.data() + point;
}

RunOutput output_at(Spectrum& spectrum, std::size_t point, std::size_t stride) {
    return {.R = place(spectrum.R, point),
            .T = place(spectrum.T, point),
            .A = place(spectrum.A, point),
            .r = place(spectrum.r, point),
            .t = place(spectrum.t, point),
            .denominator_re = place(spectrum.denominator_re, point),
            .denominator_im = place(spectrum.denominator_im, point),
            .log_scale = place(spectrum.log_scale, point),
            .stride = stride};
}

template <class T>
void copy_some(const std::vector<T>& from, std::vector<T>& to, std::size_t begin, std::size_t end) {
    if (!to.empty())
        std::copy(from.begin() + static_cast<std::ptrdiff_t>(begin),
                  from.begin() + static_cast<std::ptrdiff_t>(end),
                  to.begin() + static_cast<std::ptrdiff_t>(begin));
}

/// Points [begin, end) of one polarization are those of the other.
void copy_points(const Spectrum& from, Spectrum& to, std::size_t begin, std::size_t end) {
    for (const auto values : {&Spectrum::R, &Spectrum::T, &Spectrum::A, &Spectrum::denominator_re,
                              &Spectrum::denominator_im, &Spectrum::log_scale})
        copy_some(from.*values, to.*values, begin, end);
    for (const auto values : {&Spectrum::r, &Spectrum::t})
        copy_some(from.*values, to.*values, begin, end);
}

/// A_layers of points [begin, end) of one polarization are those of the other.
void copy_layers(const Spectrum& from, Spectrum& to, std::size_t points, std::size_t begin,
                 std::size_t end) {
    for (std::size_t first = 0; first < to.A_layers.size(); first += points)
        copy_some(from.A_layers, to.A_layers, first + begin, first + end);
}

/// Whether all points of an angle are better computed together: where both polarizations are one,
/// and where the incident wave carries no power.
bool is_special(IncidentAngle incidence) {
    return incidence.cos == 1 || incidence.cos == 0;
}

Stream stream_of_n(const IndexTable& table, std::size_t row, std::size_t wavelength, bool across) {
    return {table.n_from(row, wavelength), !across && table.row_varies(row)};
}
Stream stream_of_k(const IndexTable& table, std::size_t row, std::size_t wavelength, bool across) {
    return {table.k_from(row, wavelength), !across && table.row_varies(row)};
}

/// The extraordinary indices of a run of p alone.
void set_extraordinary(const IndexTable& table, std::size_t wavelength, bool across,
                       PointRun& run) {
    run.extraordinary_n.assign(table.materials(), {});
    run.extraordinary_k.assign(table.materials(), {});
    for (std::size_t m = 0; m < table.materials(); ++m) {
        const std::size_t row = table.extraordinary(m);
        if (row == m) continue;
        run.extraordinary_n[m] = stream_of_n(table, row, wavelength, across);
        run.extraordinary_k[m] = stream_of_k(table, row, wavelength, across);
    }
}

/// The points of a job.
///   cosines, sines  memory for those of a job along angles
void set_points(const SpectrumJob& job, const IndexTable& table,
                std::span<const IncidentAngle> incidence, PointRun& run,
                std::vector<double>& cosines, std::vector<double>& sines) {
    const bool across = job.along_angles;
    const std::size_t wavelength = across ? job.fixed : job.begin;
    run.count = job.end - job.begin;
    run.k0 = {table.k0().data() + wavelength, !across};
    run.incident = stream_of_n(table, table.incident(), wavelength, across);
    const IncidentAngle& first = incidence[across ? job.begin : job.fixed];
    run.cos_theta = {&first.cos, across};
    run.sin_theta = {&first.sin, across};
    if (across) {
        cosines.assign(run.count + kMostLanes, 1);
        sines.assign(run.count + kMostLanes, 0);
        for (std::size_t i = 0; i < run.count; ++i) {
            cosines[i] = incidence[job.begin + i].cos;
            sines[i] = incidence[job.begin + i].sin;
        }
        run.cos_theta.values = cosines.data();
        run.sin_theta.values = sines.data();
    }
    run.extraordinary_n.clear();
    run.extraordinary_k.clear();
    run.n.resize(table.materials());
    run.k.resize(table.materials());
    for (std::size_t m = 0; m < table.materials(); ++m) {
        run.n[m] = stream_of_n(table, m, wavelength, across);
        run.k[m] = stream_of_k(table, m, wavelength, across);
    }
}

/// Points by the vector kernel, which leaves some to the plain one.
class VectorRun {
public:
    /// `layers` is nullptr unless the absorption of each is requested.
    /// `means` is nullptr unless thicknesses are spread.
    VectorRun(const ChainProgram& program, const ChainLayers* layers, const SpreadProgram* means,
              PlainRun& plain, const IndexTable& table, std::span<const IncidentAngle> incidence,
              const Needs& needs, SimdLevel simd, Spectra& out, SpectrumMemory& memory)
        : program_(program),
          layers_(layers),
          means_(means),
          plain_(plain),
          table_(table),
          incidence_(incidence),
          needs_(needs),
          simd_(simd),
          out_(out),
          run_(memory.run),
          cosines_(memory.cosines),
          sines_(memory.sines),
          redo_(memory.redo),
          redo_layers_(memory.redo_layers),
          memory_(memory.kernel) {}

    void operator()(const SpectrumJob& job) {
        const std::size_t wavelengths = table_.wavelength_nm().size();
        const bool across = job.along_angles;
        const std::size_t angle = across ? job.begin : job.fixed;
        const std::size_t wavelength = across ? job.fixed : job.begin;
        const std::size_t first = angle * wavelengths + wavelength;
        const std::size_t stride = across ? wavelengths : 1;
        const bool normal = !across && incidence_[angle].cos == 1;
        set_points(job, table_, incidence_, run_, cosines_, sines_);
        // at normal incidence s stands for p
        const bool only_p = normal && !needs_.s;
        const RunOutput s = output_at(only_p ? out_.p : out_.s, first, stride);
        const RunOutput p = output_at(out_.p, first, stride);
        const std::size_t points = incidence_.size() * wavelengths;
        const LayerOutput layers_s{place(only_p ? out_.p.A_layers : out_.s.A_layers, first), points,
                                   stride};
        const LayerOutput layers_p{place(out_.p.A_layers, first), points, stride};
        redo_.clear();
        redo_layers_.clear();
        const auto pass = [&](bool with_s, bool with_p) {
            if (means_)
                return run_spread(*means_, needs_.spread_error, run_, with_s ? &s : nullptr,
                                  with_p ? &p : nullptr, redo_, memory_, simd_);
            run_chain(program_, run_, with_s ? &s : nullptr, with_p ? &p : nullptr, redo_, memory_,
                      simd_);
            if (layers_)
                run_chain_layers(program_, *layers_, run_, with_s ? &layers_s : nullptr,
                                 with_p ? &layers_p : nullptr, redo_layers_, memory_, simd_);
        };
        const bool with_s = needs_.s || normal, with_p = needs_.p && !normal;
        if (table_.is_uniaxial() && with_p) {
            if (with_s) pass(true, false);
            set_extraordinary(table_, wavelength, across, run_);
            pass(false, true);
            keep_once(redo_);
            keep_once(redo_layers_);
        } else {
            pass(with_s, with_p);
        }
        if (means_ && !redo_.empty()) throw_no_means();
        if (normal && needs_.s && needs_.p && needs_.p_at_normal) {
            copy_points(out_.s, out_.p, first, first + run_.count);
            if (layers_) copy_layers(out_.s, out_.p, points, first, first + run_.count);
        }
        const auto incidence_of = [&](std::size_t i) {
            return incidence_[across ? angle + i : angle];
        };
        const auto wavelength_of = [&](std::size_t i) {
            return across ? wavelength : wavelength + i;
        };
        for (const std::size_t i : redo_)
            plain_(incidence_of(i), wavelength_of(i), first + i * stride);
        for (const std::size_t i : redo_layers_)
            plain_.layers(incidence_of(i), wavelength_of(i), first + i * stride);
    }

private:
    const ChainProgram& program_;
    const ChainLayers* layers_;
    const SpreadProgram* means_;
    PlainRun& plain_;
    const IndexTable& table_;
    std::span<const IncidentAngle> incidence_;
    const Needs& needs_;
    SimdLevel simd_;
    Spectra& out_;
    PointRun& run_;
    std::vector<double>&cosines_, &sines_;
    std::vector<std::size_t>&redo_, &redo_layers_;
    RunMemory& memory_;
};

/// Layers and periods' layers that one point takes.
std::size_t layers_of(const ChainProgram& program) {
    std::size_t layers = 0;
    for (const auto* direction : {&program.down, &program.up})
        for (const Program& block : *direction) layers += block.order.size();
    return layers;
}

void add_jobs(std::vector<SpectrumJob>& jobs, SpectrumJob whole, std::size_t block) {
    for (std::size_t begin = whole.begin; begin < whole.end; begin += block)
        jobs.push_back(
            {whole.along_angles, whole.fixed, begin, std::min(begin + block, whole.end)});
}

/// All points, in jobs that do not depend on the number of threads.
///   by_angle  a job takes all points of an angle, and no other
void list_jobs(const IndexTable& table, std::span<const IncidentAngle> incidence, bool by_vectors,
               bool by_angle, std::vector<SpectrumJob>& jobs) {
    const std::size_t wavelengths = table.wavelength_nm().size(), angles = incidence.size();
    const std::size_t block = by_angle ? wavelengths : by_vectors ? kVectorBlock : kPlainBlock;
    const bool across =
        by_vectors && !by_angle && wavelengths < kFewWavelengths && angles > wavelengths;
    jobs.clear();
    for (std::size_t a = 0; a < angles;) {
        if (!across || is_special(incidence[a])) {
            add_jobs(jobs, {false, a, 0, wavelengths}, block);
            ++a;
            continue;
        }
        const std::size_t begin = a;
        while (a < angles && !is_special(incidence[a])) ++a;
        for (std::size_t w = 0; w < wavelengths; ++w) add_jobs(jobs, {true, w, begin, a}, block);
    }
}

/// FixedLayers of one angle.
std::span<const FixedPoints> points_at(std::size_t angle, std::size_t wavelengths,
                                       std::span<const FixedLayers* const> fixed,
                                       std::vector<FixedPoints>& points) {
    points.clear();
    std::size_t first = 0;
    for (const FixedLayers* part : fixed) {
        if (first / wavelengths == angle) points.push_back({part->numbers.data(), part->points});
        first += part->points;
    }
    return points;
}

bool any_absorbs(std::span<const Element> elements, const std::vector<bool>& absorbs) {
    return std::ranges::any_of(elements, [&](const Element& element) {
        if (const Layer* layer = std::get_if<Layer>(&element.value))
            return static_cast<bool>(absorbs[layer->material]);
        return any_absorbs(std::get<Group>(element.value).elements, absorbs);
    });
}

}  // namespace

SpectrumKernel::SpectrumKernel(const StackPower& stack, const std::vector<bool>& absorbs,
                               const std::vector<bool>& amplifies, const Needs& needs,
                               SimdLevel simd, std::span<const std::size_t> varied)
    : stack_(stack), absorbs_(absorbs), amplifies_(amplifies), needs_(needs), simd_(simd) {
    update();
    if (!is_vectorized_ || program_.down.size() > 1) return;
    const std::vector<Element>& elements = stack.chain()->blocks[0].down;
    if (needs.A && any_absorbs(elements, absorbs)) return;
    fixed_ = fixed_runs(elements, stack.chain()->substrate, absorbs, varied);
    if (shares_layers()) update();
}

void SpectrumKernel::update() {
    if (needs_.amplitudes && !stack_.has_amplitudes())
        throw DomainError("amplitudes exist for coherent layers of fixed thicknesses only");
    const Chain* chain = stack_.chain();
    is_vectorized_ = chain && simd_ != SimdLevel::plain &&
                     compile(*chain, absorbs_, amplifies_, needs_.A, fixed_, program_);
    if (needs_.layers) stack_.require_layer_list();
    const Block* const block = stack_.spread_block();
    has_means_ = block && simd_ != SimdLevel::plain && needs_.spread_error > 0 &&
                 compile(block->down, stack_.substrate(), absorbs_, needs_.spread_reach, means_);
    if (!is_vectorized_) return;
    program_.down[0].mirror = fast_mirror(stack_.mirror(), absorbs_);
    if (needs_.layers) compile_layers(*chain, stack_.listed(), absorbs_, layers_);
}

void SpectrumKernel::serve(const std::vector<bool>& absorbs, const std::vector<bool>& amplifies,
                           const Needs& needs, SimdLevel simd) {
    absorbs_ = absorbs;
    amplifies_ = amplifies;
    needs_ = needs;
    simd_ = simd;
    fixed_ = {};
    update();
}

void SpectrumKernel::fix_layers(const IndexTable& table, IncidentAngle incidence, FixedLayers& out,
                                SpectrumMemory& memory) const {
    out.points = table.wavelength_nm().size();
    out.numbers.clear();
    if (incidence.cos == 0) return;  // for the plain kernel
    out.numbers.resize(whole_vectors(out.points) * fixed_.rows);
    set_points({false, 0, 0, out.points}, table, {&incidence, 1}, memory.run, memory.cosines,
               memory.sines);
    const bool normal = incidence.cos == 1;
    const auto store = [&](bool s, bool p) {
        for (const FixedRun& run : fixed_.runs)
            store_fixed(run, memory.run, s, p, fixed_.rows, out.numbers.data(), memory.kernel,
                        simd_);
    };
    const bool s = needs_.s || normal, p = needs_.p && !normal;
    if (!table.is_uniaxial() || !p) return store(s, p);
    if (s) store(true, false);
    set_extraordinary(table, 0, false, memory.run);
    store(false, true);
}

void SpectrumKernel::fix_all_layers(const IndexTable& table,
                                    std::span<const IncidentAngle> incidence,
                                    SpectrumMemory& memory) const {
    memory.fixed_parts.clear();
    if (!shares_layers() || !by_vectors(table)) return;
    memory.fixed.resize(incidence.size());
    for (std::size_t angle = 0; angle < incidence.size(); ++angle) {
        fix_layers(table, incidence[angle], memory.fixed[angle], memory);
        memory.fixed_parts.push_back(&memory.fixed[angle]);
    }
}

bool SpectrumKernel::by_vectors(const IndexTable& table) const {
    if (has_means_)
        return means_.program.largest_thickness_nm * table.largest_wavenumber() <= kLargestPhase;
    if (!is_vectorized_) return false;
    for (const Program& block : program_.down)
        if (block.largest_thickness_nm * table.largest_wavenumber() > kLargestPhase) return false;
    return true;
}

void SpectrumKernel::prepare(const IndexTable& table, std::span<const IncidentAngle> incidence,
                             Spectra& out, std::vector<SpectrumJob>& jobs) const {
    const std::size_t points = incidence.size() * table.wavelength_nm().size();
    const std::size_t layers = needs_.layers ? stack_.layer_count() : 0;
    const bool vectors = by_vectors(table);
    allocate(out.s, needs_, needs_.s ? points : 0, layers);
    allocate(out.p, needs_, needs_.p ? points : 0, layers);
    list_jobs(table, incidence, vectors, shares_layers(), jobs);
}

void SpectrumKernel::run(std::span<const SpectrumJob> jobs, const IndexTable& table,
                         std::span<const IncidentAngle> incidence,
                         std::span<const FixedLayers* const> fixed, Spectra& out,
                         SpectrumMemory& memory) const {
    if (needs_.spread_error > 0 && !has_means_ && !stack_.chain()) throw_no_means();
    const std::size_t wavelengths = table.wavelength_nm().size();
    PlainRun plain(stack_, table, needs_, out);
    std::optional<VectorRun> vector;
    if (by_vectors(table))
        vector.emplace(program_, needs_.layers ? &layers_ : nullptr, has_means_ ? &means_ : nullptr,
                       plain, table, incidence, needs_, simd_, out, memory);
    for (const SpectrumJob& job : jobs) {
        const bool grazing = !job.along_angles && incidence[job.fixed].cos == 0;
        if (vector && !grazing) {
            memory.run.fixed_rows = fixed_.rows;
            memory.run.fixed = shares_layers()
                                   ? points_at(job.fixed, wavelengths, fixed, memory.fixed_points)
                                   : std::span<const FixedPoints>();
            (*vector)(job);
            continue;
        }
        for (std::size_t w = job.begin; w < job.end; ++w)
            plain(incidence[job.fixed], w, job.fixed * wavelengths + w);
    }
}

void SpectrumKernel::operator()(const IndexTable& table, std::span<const IncidentAngle> incidence,
                                Spectra& out, SpectrumMemory& memory) const {
    fix_all_layers(table, incidence, memory);
    (*this)(table, incidence, memory.fixed_parts, out, memory);
}

void SpectrumKernel::operator()(const IndexTable& table, std::span<const IncidentAngle> incidence,
                                std::span<const FixedLayers* const> fixed, Spectra& out,
                                SpectrumMemory& memory) const {
    prepare(table, incidence, out, memory.jobs);
    run(memory.jobs, table, incidence, fixed, out, memory);
}

void SpectrumKernel::operator()(const IndexTable& table, std::span<const IncidentAngle> incidence,
                                unsigned threads, Spectra& out) const {
    SpectrumMemory memory;
    const std::size_t listed = needs_.layers ? stack_.layer_count() : 0;
    const double unit =
        by_vectors(table) ? kVectorWork * static_cast<double>(layers_of(program_) + 2 * listed + 2)
                          : kPlainWork;
    const auto points = static_cast<double>(incidence.size() * table.wavelength_nm().size());
    if (threads == 1 || points * unit < kLittleWork) return (*this)(table, incidence, out, memory);
    prepare(table, incidence, out, memory.jobs);
    fix_all_layers(table, incidence, memory);
    parallel_for(memory.jobs.size(), threads, [&](std::size_t j) {
        SpectrumMemory own;
        run(std::span(memory.jobs).subspan(j, 1), table, incidence, memory.fixed_parts, out, own);
    });
}

Work SpectrumKernel::work(const IndexTable& table, std::span<const IncidentAngle> incidence) const {
    Work work{.points = incidence.size() * table.wavelength_nm().size()};
    work.normal_angles =
        static_cast<std::size_t>(std::ranges::count(incidence, 1.0, &IncidentAngle::cos));
    if (!by_vectors(table) || has_means_) return work;
    work.kernel = simd_;
    work.passes = program_.down.size() + program_.up.size();
    const bool incident_is_constant = table.is_constant(table.incident());
    std::set<std::size_t> media, constant_media;
    for (const Program& block : program_.down) {
        work.layers += block.order.size();
        for (const std::uint32_t layer : block.order)
            if (!block.media[block.layers[layer].medium].absorbs) ++work.transparent_layers;
        work.distinct_layers += block.shares_layers ? block.layers.size() : block.order.size();
        work.powers += static_cast<std::size_t>(
            std::ranges::count_if(block.steps, [](const Program::Step& step) {
                return step.kind == Program::Kind::group ||
                       step.kind == Program::Kind::absorbing_group;
            }));
        for (const Program::UsedMedium& medium : block.media) {
            media.insert(medium.material);
            if (incident_is_constant && table.is_constant(medium.material))
                constant_media.insert(medium.material);
        }
        work.absorbs |= block.absorbs;
    }
    work.media = media.size();
    work.constant_media = constant_media.size();
    const bool constant = work.constant_media == work.media;
    const std::optional<HostedMirror>& mirror = program_.down[0].mirror;
    work.mirror = mirror && mirror->serves(needs_.amplitudes, needs_.denominators);
    work.one_film = work.passes == 1 && program_.down[0].is_one_film();
    const bool both = needs_.s && needs_.p && work.normal_angles < incidence.size();
    if (work.mirror) {
        work.layers = work.transparent_layers = work.distinct_layers = 2;
        work.powers = 1;
        work.operations_per_point = operations_of_mirror(both ? 2 : 1, constant);
        return work;
    }
    for (const auto* direction : {&program_.down, &program_.up})
        for (const Program& block : *direction)
            work.operations_per_point += operations_per_point(block, both ? 2 : 1, constant);
    return work;
}

Spectra spectra(const StackPower& stack, const IndexTable& table,
                std::span<const IncidentAngle> incidence, const Needs& needs,
                const Execution& execution) {
    Spectra out;
    spectra(stack, table, incidence, needs, execution, out);
    return out;
}

void spectra(const StackPower& stack, const IndexTable& table,
             std::span<const IncidentAngle> incidence, const Needs& needs,
             const Execution& execution, Spectra& out) {
    SpectrumKernel(stack, table.absorbs(), table.amplifies(), needs, execution.simd)(
        table, incidence, execution.threads, out);
}

Work work_of(const StackPower& stack, const IndexTable& table,
             std::span<const IncidentAngle> incidence, const Needs& needs,
             const Execution& execution) {
    return SpectrumKernel(stack, table.absorbs(), table.amplifies(), needs, execution.simd)
        .work(table, incidence);
}

}  // namespace irido
