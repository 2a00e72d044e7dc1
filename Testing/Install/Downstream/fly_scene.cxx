// SPDX-License-Identifier: BSD-3-Clause
// Flies a scene, moves its first mark, flies on, and says where body 0 is at the mark's frame.
#include <vtkMotionAnimationSource.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <cstdlib>
#include <iostream>

namespace
{

constexpr int Poses = 1; // port

bool Fly(vtkMotionAnimationSource* flight, vtkIdType frame)
{
  flight->Update();
  vtkPolyData* poses = vtkPolyData::SafeDownCast(flight->GetOutputDataObject(Poses));
  if (poses->GetNumberOfLines() == 0) // it has said why
  {
    return false;
  }
  const double* place = poses->GetPoint(frame); // body after body, each frame by frame
  std::cout << place[0] << " " << place[1] << " " << place[2] << "\n";
  return true;
}

} // namespace

int main(int count, char** words) // SCENE FRAME
{
  if (count < 3)
  {
    return EXIT_FAILURE;
  }
  vtkSMPTools::SetBackend("STDThread");
  vtkNew<vtkMotionAnimationSource> flight;
  flight->SetFileName(words[1]);
  flight->SetQuality(vtkMotionAnimationSource::PREVIEW);
  const vtkIdType frame = std::atoi(words[2]);
  if (!Fly(flight, frame))
  {
    return EXIT_FAILURE;
  }
  flight->SetEdits(
    R"([{"op": "replace", "path": "/constraints/0/value", "value": [0.6, 0.2, 1.3]}])");
  return Fly(flight, frame) ? EXIT_SUCCESS : EXIT_FAILURE;
}
