// SPDX-License-Identifier: BSD-3-Clause
// The four pair sums over the neighbour lists (Shi et al. 2005, Appendix B, with v_ij = v_i - v_j)
// and their adjoint, written once for any Lanes. A pair is visited once: what i gets from j is up
// to the masses minus what j gets from i. j is always gas.

/// Pairs of many particles come from farther than the second cache.
constexpr std::size_t GroupsAhead = 12;

inline void Prefetch(const SphPairGroup* group)
{
  const char* first = reinterpret_cast<const char*>(group);
  __builtin_prefetch(first);
  __builtin_prefetch(first + 64);
  __builtin_prefetch(first + 128);
}

/// Four floats of each other of a pair, loaded a group ahead, while the sums over the last one
/// still wait for results.
struct LoadedAhead
{
  const float* Base;
  Lanes Next[4];

  LoadedAhead(const float* base, const SphPairs& pairs) : Base(base)
  {
    LoadFour<1>(base, pairs.Groups->Other, this->Next);
  }
  /// Groups in their order.
  void Take(const SphPairGroup& group, Lanes out[4])
  {
    for (int a = 0; a < 4; ++a)
    {
      out[a] = this->Next[a];
    }
    LoadFour<1>(this->Base, (&group + 1)->Other, this->Next);
  }
};

/// Eight pairs of one i, as they are found: x_i - x_j, and j's slot as the bits of lanes.
struct FoundPairs
{
  Lanes X, Y, Z, Other;

  template <typename Function>
  static FoundPairs Each(Function function)
  {
    return { function(&FoundPairs::X), function(&FoundPairs::Y), function(&FoundPairs::Z),
             function(&FoundPairs::Other) };
  }
  void Store(SphPairGroup* out) const
  {
    this->X.Store(out->X);
    this->Y.Store(out->Y);
    this->Z.Store(out->Z);
    StoreBits(this->Other, out->Other);
  }
};

inline FoundPairs Select(LaneMask mask, const FoundPairs& yes, const FoundPairs& no)
{
  return FoundPairs::Each([&](auto part) { return Select(mask, yes.*part, no.*part); });
}

/// Puts the pairs of one i after the other's together to full groups.
struct PairPacker
{
  SphPairGroup* Out;
  FoundPairs Waiting; // as many as Count, for their group to be full
  unsigned Count;

  /// Takes the lanes of a mask. Writes the group at hand, full or not.
  void Take(unsigned mask, const FoundPairs& found)
  {
    const LaneOrder order(mask, this->Count);
    const FoundPairs moved = FoundPairs::Each([&](auto part) { return order(found.*part); });
    const FoundPairs joined = Select(LanesFrom(this->Count), moved, this->Waiting);
    joined.Store(this->Out);
    const unsigned total = this->Count + static_cast<unsigned>(__builtin_popcount(mask));
    const unsigned full = total / 8;
    this->Waiting = Select(LanesFrom(8 - 8 * full), moved, joined); // the rest lies in front
    this->Count = total % 8;
    this->Out += full;
  }
  /// Fills the last group, and waits for the next i's pairs.
  void Fill(const FoundPairs& far)
  {
    if (this->Count > 0)
    {
      Select(LanesFrom(this->Count), far, this->Waiting).Store(this->Out);
      ++this->Out;
      this->Count = 0;
    }
  }
};

/// The pairs within the support of the particles from begin to end: all but s; slots in Other.
template <typename Index>
void FindPairs(const SphConstants& c, const SphRecord* records, const std::uint32_t* starts,
               const Index* list, std::size_t begin, std::size_t end, const FoundPairs& far,
               const SphPairs& pairs)
{
  const float* base = &records->X;
  const Lanes support2 = Lanes::Set(1.0f / (c.InverseSupport * c.InverseSupport));
  PairPacker packer{ pairs.Groups + pairs.Starts[begin], far, 0 };
  for (std::size_t i = begin; i < end; ++i)
  {
    const Lanes xi = Lanes::Set(records[i].X);
    const Lanes yi = Lanes::Set(records[i].Y);
    const Lanes zi = Lanes::Set(records[i].Z);
    for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
    {
      Lanes q[4];
      LoadFour<8>(base, list + 8 * k, q);
      const FoundPairs pair{ xi - q[0], yi - q[1], zi - q[2], LoadBits(list + 8 * k) };
      const Lanes r2 = Fma(pair.X, pair.X, Fma(pair.Y, pair.Y, pair.Z * pair.Z));
      packer.Take((r2 < support2).Bits(), pair);
    }
    packer.Fill(far);
    pairs.Starts[i + 1] = static_cast<std::uint32_t>(packer.Out - pairs.Groups);
  }
}

/// The density of these pairs. Makes slots in Other offsets where records begin.
void WeighPairs(const SphConstants& c, const SphRecord* records, std::size_t begin, std::size_t end,
                const SphPairs& pairs, float* density)
{
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes five = Lanes::Set(5.0f);
  const Lanes four = Lanes::Set(4.0f);
  const Lanes inverse = Lanes::Set(c.InverseSupport);
  for (std::size_t i = begin; i < end; ++i)
  {
    const Lanes scale = Lanes::Set(c.KernelScale * records[i].Mass);
    Lanes sum = zero, nearest = zero;
    for (std::size_t k = pairs.Starts[i]; k < pairs.Starts[i + 1]; ++k)
    {
      SphPairGroup& pair = pairs.Groups[k];
      const Lanes x = Lanes::Load(pair.X);
      const Lanes y = Lanes::Load(pair.Y);
      const Lanes z = Lanes::Load(pair.Z);
      const Lanes s = Max(zero, Fnma(Sqrt(Fma(x, x, Fma(y, y, z * z))), inverse, one));
      s.Store(pair.S);
      nearest = Max(nearest, s);
      const Lanes s2 = s * s;
      const Lanes w = scale * ((s2 * s2) * Fnma(four, s, five));
      sum = sum + w;
      float weights[8];
      w.Store(weights);
      for (int l = 0; l < 8; ++l)
      {
        density[pair.Other[l]] += weights[l];
      }
      TimesEight(pair.Other);
    }
    pairs.Nearest[i] = Largest(nearest);
    density[i] += c.GasMass / records[i].Mass * Sum(sum);
  }
}

template <typename Index>
void DensitySum(const SphConstants& c, const SphRecord* records, const std::uint32_t* starts,
                const Index* list, std::size_t n, const SphPairs& pairs, float* density)
{
  // Pairs are weighed while they are in the first cache, and no sooner than their number is known.
  constexpr std::size_t Block = 32;
  std::uint32_t slots[8];
  for (std::uint32_t l = 0; l < 8; ++l)
  {
    slots[l] = static_cast<std::uint32_t>(n) + l;
  }
  // At the edge of the support and beyond all terms vanish.
  const Lanes beyond = Lanes::Set(1.0f / c.InverseSupport);
  const FoundPairs far{ beyond, beyond, beyond, LoadBits(slots) };
  for (std::size_t i = 0; i < n; ++i)
  {
    density[i] = 0.0f;
  }
  pairs.Starts[0] = 0;
  for (std::size_t begin = 0; begin < n; begin += Block)
  {
    const std::size_t end = begin + Block < n ? begin + Block : n;
    FindPairs(c, records, starts, list, begin, end, far, pairs);
    WeighPairs(c, records, begin, end, pairs, density);
  }
  SphPairGroup* last = pairs.Groups + pairs.Starts[n];
  far.Store(last);
  TimesEight(last->Other);
}

void AccelerationSum(const SphConstants& c, const SphRecord* records, const SphPairs& pairs,
                     std::size_t n, SphPairSum* sums)
{
  float* sumBase = sums->First;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes five = Lanes::Set(5.0f);
  const Lanes four = Lanes::Set(4.0f);
  const Lanes core = Lanes::Set(c.ViscousCore);
  LoadedAhead velocities(&records->U, pairs);
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const Lanes ui = Lanes::Set(me.U), vi = Lanes::Set(me.V), wi = Lanes::Set(me.W);
    const Lanes pi = Lanes::Set(me.Pressure);
    const Lanes forceScale = Lanes::Set(-c.GradientScale * me.Mass);
    const Lanes averageScale = Lanes::Set(-c.KernelScale * me.Mass);
    const Lanes kappa = Lanes::Set(me.Mass < c.ObjectMassThreshold ? c.ObjectKappa : c.Kappa);
    Lanes own[8] = { zero, zero, zero, zero, zero, zero, zero, zero };
    for (std::size_t k = pairs.Starts[i]; k < pairs.Starts[i + 1]; ++k)
    {
      const SphPairGroup& pair = pairs.Groups[k];
      Prefetch(&pair + GroupsAhead);
      Lanes w[4];
      velocities.Take(pair, w);
      const Lanes x = Lanes::Load(pair.X);
      const Lanes y = Lanes::Load(pair.Y);
      const Lanes z = Lanes::Load(pair.Z);
      const Lanes s = Lanes::Load(pair.S);
      const Lanes u = ui - w[0], v = vi - w[1], t = wi - w[2];
      const Lanes r2 = Fma(x, x, Fma(y, y, z * z));
      const Lanes s2 = s * s;
      const Lanes vx = Fma(u, x, Fma(v, y, t * z));
      const Lanes tension = Fnma(kappa, vx / (r2 + core), pi + w[3]);
      const Lanes factor = (tension * forceScale) * (s2 * s);
      const Lanes weight = (averageScale * (s2 * s2)) * Fnma(four, s, five);
      const Lanes terms[8] = { factor * x, factor * y, factor * z, zero,
                               weight * u, weight * v, weight * t, zero };
      for (int a = 0; a < 8; ++a)
      {
        own[a] = own[a] + terms[a];
      }
      SubtractRecords(sumBase, pair.Other, terms);
    }
    // The sums are of m_i; i's own are of its neighbours' mass.
    const Lanes others = Lanes::Set(c.GasMass / me.Mass);
    for (Lanes& a : own)
    {
      a = others * a;
    }
    AddSums(sumBase + 8 * i, own);
  }
}

void AdjointPressureSum(const SphConstants& c, const SphRecord* records,
                        const SphAdjointRecord* adjoints, const SphPairs& pairs, std::size_t n,
                        float* pressure)
{
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes scale = Lanes::Set(-c.GradientScale);
  const Lanes mj = Lanes::Set(c.GasMass);
  LoadedAhead accelerations(&adjoints->AX, pairs);
  for (std::size_t i = 0; i < n; ++i)
  {
    pressure[i] = 0.0f;
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const SphAdjointRecord& bar = adjoints[i];
    const Lanes mi = Lanes::Set(me.Mass);
    const Lanes ai = mj * Lanes::Set(bar.AX);
    const Lanes bi = mj * Lanes::Set(bar.AY);
    const Lanes ci = mj * Lanes::Set(bar.AZ);
    Lanes sum = zero;
    for (std::size_t k = pairs.Starts[i]; k < pairs.Starts[i + 1]; ++k)
    {
      const SphPairGroup& pair = pairs.Groups[k];
      Prefetch(&pair + GroupsAhead);
      Lanes b[4];
      accelerations.Take(pair, b);
      const Lanes x = Lanes::Load(pair.X);
      const Lanes y = Lanes::Load(pair.Y);
      const Lanes z = Lanes::Load(pair.Z);
      const Lanes s = Lanes::Load(pair.S);
      const Lanes bx = Fnma(mi, b[0], ai);
      const Lanes by = Fnma(mi, b[1], bi);
      const Lanes bz = Fnma(mi, b[2], ci);
      const Lanes value = (scale * (s * s) * s) * Fma(bx, x, Fma(by, y, bz * z));
      sum = sum + value;
      float values[8];
      value.Store(values);
      for (int l = 0; l < 8; ++l)
      {
        pressure[pair.Other[l] / 8] += values[l];
      }
    }
    pressure[i] += Sum(sum);
  }
}

void AdjointStateSum(const SphConstants& c, const SphRecord* records,
                     const SphAdjointRecord* adjoints, const SphPairs& pairs, std::size_t n,
                     SphPairSum* sums)
{
  const float* base = &records->X;
  float* sumBase = sums->First;
  const float* adjointBase = &adjoints->AX;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes tiny = Lanes::Set(1e-6f);
  const Lanes support = Lanes::Set(1.0f / c.InverseSupport);
  const Lanes core = Lanes::Set(c.ViscousCore);
  const Lanes gradient = Lanes::Set(c.GradientScale);
  const Lanes second = Lanes::Set(c.SecondScale);
  const Lanes kernel5 = Lanes::Set(5.0f * c.KernelScale);
  const Lanes kernel4 = Lanes::Set(4.0f * c.KernelScale);
  const Lanes mj = Lanes::Set(c.GasMass);
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const SphAdjointRecord& bar = adjoints[i];
    const Lanes ui = Lanes::Set(me.U), vi = Lanes::Set(me.V), wi = Lanes::Set(me.W);
    const Lanes mi = Lanes::Set(me.Mass), pi = Lanes::Set(me.Pressure);
    const Lanes ai = mj * Lanes::Set(bar.AX);
    const Lanes bi = mj * Lanes::Set(bar.AY);
    const Lanes ci = mj * Lanes::Set(bar.AZ);
    const Lanes di = mj * Lanes::Set(bar.DX);
    const Lanes ei = mj * Lanes::Set(bar.DY);
    const Lanes fi = mj * Lanes::Set(bar.DZ);
    const Lanes densityBar = mj * Lanes::Set(bar.Density);
    const Lanes kappa = Lanes::Set(me.Mass < c.ObjectMassThreshold ? c.ObjectKappa : c.Kappa);
    Lanes own[8] = { zero, zero, zero, zero, zero, zero, zero, zero };
    for (std::size_t k = pairs.Starts[i]; k < pairs.Starts[i + 1]; ++k)
    {
      const SphPairGroup& pair = pairs.Groups[k];
      Prefetch(&pair + GroupsAhead);
      Lanes w[4], b[4], d[4];
      LoadFour<1>(base + 4, pair.Other, w);
      LoadFour<1>(adjointBase, pair.Other, b);
      LoadFour<1>(adjointBase + 4, pair.Other, d);
      const Lanes x = Lanes::Load(pair.X);
      const Lanes y = Lanes::Load(pair.Y);
      const Lanes z = Lanes::Load(pair.Z);
      const Lanes s = Lanes::Load(pair.S);
      const Lanes u = ui - w[0], v = vi - w[1], t = wi - w[2];
      const Lanes r2 = Fma(x, x, Fma(y, y, z * z));
      // s = 1 - r / 2h gives r back; one division does for 1 / r and 1 / (r^2 + core).
      const Lanes r = Max(Fnma(s, support, support), tiny);
      const Lanes near = r2 + core;
      const Lanes both = one / (r * near);
      const Lanes guard = both * r;
      const Lanes s2 = s * s;
      const Lanes F = gradient * (s2 * s);
      const Lanes G = (second * s2) * (both * near);
      const Lanes W = (s2 * s2) * Fnma(kernel4, s, kernel5);
      const Lanes bx = Fnma(mi, b[0], ai);
      const Lanes by = Fnma(mi, b[1], bi);
      const Lanes bz = Fnma(mi, b[2], ci);
      const Lanes Bx = Fnma(mi, d[0], di);
      const Lanes By = Fnma(mi, d[1], ei);
      const Lanes Bz = Fnma(mi, d[2], fi);
      const Lanes bDotX = Fma(bx, x, Fma(by, y, bz * z));
      const Lanes vDotX = Fma(u, x, Fma(v, y, t * z));
      const Lanes BDotV = Fma(Bx, u, Fma(By, v, Bz * t));
      const Lanes approach = vDotX * guard;
      const Lanes tension = Fnma(kappa, approach, pi + w[3]);
      const Lanes viscous = (kappa * F) * (bDotX * guard);
      const Lanes density = Fma(mi, b[3], densityBar);
      // The factor of x_ij: geometric stiffness, viscosity, average and density.
      Lanes along = F * (density - BDotV);
      along = Fnma(tension * G, bDotX, along);
      along = Fnma(viscous + viscous, approach, along);
      const Lanes stress = tension * F;
      const Lanes terms[8] = { Fma(along, x, Fma(viscous, u, zero - stress * bx)),
                               Fma(along, y, Fma(viscous, v, zero - stress * by)),
                               Fma(along, z, Fma(viscous, t, zero - stress * bz)),
                               zero,
                               Fnma(W, Bx, viscous * x),
                               Fnma(W, By, viscous * y),
                               Fnma(W, Bz, viscous * z),
                               zero };
      for (int a = 0; a < 8; ++a)
      {
        own[a] = own[a] + terms[a];
      }
      SubtractRecords(sumBase, pair.Other, terms);
    }
    AddSums(sumBase + 8 * i, own);
  }
}
