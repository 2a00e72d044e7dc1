// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/LetterSpacing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace waft
{

namespace
{

constexpr float InkLevel = 0.05f;

struct Letter
{
  std::vector<int> Labels; // of the connected parts
  int Left = 0;
  int Right = 0;
};

// Numbers the connected parts of the ink (8 neighbours); -1: no ink.
std::vector<int> LabelInk(const Picture& text, std::vector<Letter>& parts)
{
  std::vector<int> labels(text.Pixels.size(), -1);
  for (std::size_t start = 0; start < labels.size(); ++start)
  {
    if (labels[start] >= 0 || text.Pixels[start][3] < InkLevel)
    {
      continue;
    }
    const int label = static_cast<int>(parts.size());
    Letter part;
    part.Labels = { label };
    part.Left = text.Width;
    part.Right = -1;
    std::vector<std::size_t> open{ start };
    labels[start] = label;
    while (!open.empty())
    {
      const auto x = static_cast<int>(open.back() % static_cast<std::size_t>(text.Width));
      const auto y = static_cast<int>(open.back() / static_cast<std::size_t>(text.Width));
      open.pop_back();
      part.Left = std::min(part.Left, x);
      part.Right = std::max(part.Right, x);
      for (int v = std::max(0, y - 1); v <= std::min(text.Height - 1, y + 1); ++v)
      {
        for (int u = std::max(0, x - 1); u <= std::min(text.Width - 1, x + 1); ++u)
        {
          const std::size_t next = static_cast<std::size_t>(v) * text.Width + u;
          if (labels[next] < 0 && text.Pixels[next][3] >= InkLevel)
          {
            labels[next] = label;
            open.push_back(next);
          }
        }
      }
    }
    parts.push_back(std::move(part));
  }
  return labels;
}

// Parts that have in common most of their width are one letter; letters from left to right.
std::vector<Letter> JoinParts(std::vector<Letter> parts)
{
  std::sort(parts.begin(), parts.end(),
            [](const Letter& a, const Letter& b) { return a.Left + a.Right < b.Left + b.Right; });
  std::vector<Letter> letters;
  for (const Letter& part : parts)
  {
    if (!letters.empty())
    {
      Letter& last = letters.back();
      const int shared = std::min(last.Right, part.Right) - std::max(last.Left, part.Left) + 1;
      if (2 * shared > std::min(last.Right - last.Left, part.Right - part.Left) + 1)
      {
        last.Labels.insert(last.Labels.end(), part.Labels.begin(), part.Labels.end());
        last.Left = std::min(last.Left, part.Left);
        last.Right = std::max(last.Right, part.Right);
        continue;
      }
    }
    letters.push_back(part);
  }
  return letters;
}

} // namespace

Picture SpreadLetters(const Picture& text, double gap)
{
  std::vector<Letter> parts;
  const std::vector<int> labels = LabelInk(text, parts);
  const std::vector<Letter> letters = JoinParts(parts);
  std::vector<int> letterOf(parts.size(), 0);
  for (std::size_t l = 0; l < letters.size(); ++l)
  {
    for (const int label : letters[l].Labels)
    {
      letterOf[static_cast<std::size_t>(label)] = static_cast<int>(l);
    }
  }
  // The first and last ink of each letter in each row.
  const auto rows = static_cast<std::size_t>(text.Height);
  std::vector<std::vector<int>> first(letters.size(), std::vector<int>(rows, text.Width * 8));
  std::vector<std::vector<int>> last(letters.size(), std::vector<int>(rows, -text.Width * 8));
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] >= 0)
    {
      const auto l = static_cast<std::size_t>(letterOf[static_cast<std::size_t>(labels[i])]);
      const std::size_t y = i / static_cast<std::size_t>(text.Width);
      const auto x = static_cast<int>(i % static_cast<std::size_t>(text.Width));
      first[l][y] = std::min(first[l][y], x);
      last[l][y] = std::max(last[l][y], x);
    }
  }
  std::vector<int> shifts(letters.size(), 0);
  const int reach = static_cast<int>(gap);
  for (std::size_t l = 1; l < letters.size(); ++l)
  {
    int room = text.Width * 8;
    for (int y = 0; y < text.Height; ++y)
    {
      for (int v = std::max(0, y - reach); v <= std::min(text.Height - 1, y + reach); ++v)
      {
        room = std::min(room, first[l][static_cast<std::size_t>(v)] -
                                last[l - 1][static_cast<std::size_t>(y)] - 1);
      }
    }
    shifts[l] = shifts[l - 1] + std::max(0, static_cast<int>(std::ceil(gap)) - room);
  }
  Picture spread;
  spread.Width = text.Width + (shifts.empty() ? 0 : shifts.back());
  spread.Height = text.Height;
  spread.Pixels.assign(static_cast<std::size_t>(spread.Width) * rows, { 0.f, 0.f, 0.f, 0.f });
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] >= 0)
    {
      const int l = letterOf[static_cast<std::size_t>(labels[i])];
      const std::size_t y = i / static_cast<std::size_t>(text.Width);
      const std::size_t x =
        i % static_cast<std::size_t>(text.Width) + static_cast<std::size_t>(shifts[l]);
      spread.Pixels[y * static_cast<std::size_t>(spread.Width) + x] = text.Pixels[i];
    }
  }
  return spread;
}

} // namespace waft
