// SPDX-License-Identifier: BSD-3-Clause
// Eight floats as an array, for any machine.
struct Lanes
{
  float Value[8];

  static Lanes Set(float a) { return { { a, a, a, a, a, a, a, a } }; }
  static Lanes Load(const float* p)
  {
    Lanes r;
    for (int k = 0; k < 8; ++k)
    {
      r.Value[k] = p[k];
    }
    return r;
  }
  void Store(float* p) const
  {
    for (int k = 0; k < 8; ++k)
    {
      p[k] = this->Value[k];
    }
  }
};

template <typename Function>
inline Lanes Each(Function function)
{
  Lanes r;
  for (int k = 0; k < 8; ++k)
  {
    r.Value[k] = function(k);
  }
  return r;
}

inline Lanes operator+(const Lanes& a, const Lanes& b)
{
  return Each([&](int k) { return a.Value[k] + b.Value[k]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b)
{
  return Each([&](int k) { return a.Value[k] - b.Value[k]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b)
{
  return Each([&](int k) { return a.Value[k] * b.Value[k]; });
}
inline Lanes operator/(const Lanes& a, const Lanes& b)
{
  return Each([&](int k) { return a.Value[k] / b.Value[k]; });
}
inline Lanes Fma(const Lanes& a, const Lanes& b, const Lanes& c)
{
  return Each([&](int k) { return a.Value[k] * b.Value[k] + c.Value[k]; });
}
inline Lanes Fnma(const Lanes& a, const Lanes& b, const Lanes& c)
{
  return Each([&](int k) { return c.Value[k] - a.Value[k] * b.Value[k]; });
}
inline Lanes Max(const Lanes& a, const Lanes& b)
{
  return Each([&](int k) { return a.Value[k] > b.Value[k] ? a.Value[k] : b.Value[k]; });
}
inline Lanes Min(const Lanes& a, const Lanes& b)
{
  return Each([&](int k) { return a.Value[k] < b.Value[k] ? a.Value[k] : b.Value[k]; });
}
inline Lanes Floor(const Lanes& a)
{
  return Each([&](int k) { return __builtin_floorf(a.Value[k]); });
}
inline Lanes Gather(const float* values, const Lanes& index)
{
  return Each([&](int k) { return values[static_cast<int>(index.Value[k])]; });
}
inline Lanes Sqrt(const Lanes& a)
{
  return Each([&](int k) { return __builtin_sqrtf(a.Value[k]); });
}

struct LaneMask
{
  unsigned Value; // a bit a lane

  unsigned Bits() const { return this->Value; }
};

inline LaneMask operator<(const Lanes& a, const Lanes& b)
{
  unsigned mask = 0;
  for (int k = 0; k < 8; ++k)
  {
    mask |= a.Value[k] < b.Value[k] ? 1u << k : 0u;
  }
  return { mask };
}
inline LaneMask LanesFrom(unsigned first)
{
  return { 0xFFu << first };
}
inline Lanes Select(LaneMask mask, const Lanes& yes, const Lanes& no)
{
  return Each([&](int k) { return mask.Value & (1u << k) ? yes.Value[k] : no.Value[k]; });
}
inline float Sum(const Lanes& a)
{
  const float* v = a.Value;
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

inline float Largest(const Lanes& a)
{
  float largest = a.Value[0];
  for (float value : a.Value)
  {
    largest = value > largest ? value : largest;
  }
  return largest;
}
inline void TimesEight(std::uint32_t* values)
{
  for (int k = 0; k < 8; ++k)
  {
    values[k] *= 8;
  }
}

template <std::size_t Scale, typename Index>
inline void LoadFour(const float* base, const Index* index, Lanes out[4])
{
  for (int k = 0; k < 8; ++k)
  {
    const float* record = base + Scale * static_cast<std::size_t>(index[k]);
    for (int c = 0; c < 4; ++c)
    {
      out[c].Value[k] = record[c];
    }
  }
}

inline void SubtractRecords(float* base, const std::uint32_t* offsets, const Lanes components[8])
{
  for (int k = 0; k < 8; ++k)
  {
    float* record = base + offsets[k];
    for (int c = 0; c < 8; ++c)
    {
      record[c] -= components[c].Value[k];
    }
  }
}

inline void AddSums(float* record, const Lanes components[8])
{
  for (int c = 0; c < 8; ++c)
  {
    record[c] += Sum(components[c]);
  }
}

struct LaneOrder
{
  int From[8] = {};

  LaneOrder(unsigned mask, unsigned first)
  {
    for (int k = 0; k < 8; ++k)
    {
      if (mask & (1u << k))
      {
        this->From[first++ % 8] = k;
      }
    }
  }
  Lanes operator()(const Lanes& a) const
  {
    return Each([&](int k) { return a.Value[this->From[k]]; });
  }
};

template <typename Index>
inline Lanes LoadBits(const Index* p)
{
  Lanes r;
  for (int k = 0; k < 8; ++k)
  {
    const std::uint32_t wide = p[k];
    __builtin_memcpy(r.Value + k, &wide, sizeof(wide));
  }
  return r;
}
inline Lanes BitsFrom(std::uint32_t first)
{
  std::uint32_t whole[8];
  for (std::uint32_t k = 0; k < 8; ++k)
  {
    whole[k] = first + k;
  }
  return LoadBits(whole);
}
inline void StoreBits(const Lanes& a, std::uint32_t* p)
{
  __builtin_memcpy(p, a.Value, sizeof(a.Value));
}

struct DoubleSum
{
  double Value[8] = {};

  void AddProduct(const Lanes& a, const Lanes& b)
  {
    for (int k = 0; k < 8; ++k)
    {
      this->Value[k] += static_cast<double>(a.Value[k]) * b.Value[k];
    }
  }
  double Total() const
  {
    const double* v = this->Value;
    return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
  }
};
