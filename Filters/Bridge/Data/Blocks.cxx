// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/Blocks.h"

#include "Bridge/Data/ArrayNames.h"

#include <vtkAppendPolyData.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <set>

namespace waft
{
namespace
{

bool IsEmpty(vtkDataObject* data)
{
  return data->GetNumberOfElements(vtkDataObject::POINT) == 0 &&
         data->GetNumberOfElements(vtkDataObject::CELL) == 0 &&
         data->GetNumberOfElements(vtkDataObject::ROW) == 0;
}

// The blocks that have something in them; data without blocks by themselves, empty or not.
std::vector<vtkDataObject*> LeavesOf(vtkDataObject* data)
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (blocks == nullptr)
  {
    return { data };
  }
  std::vector<vtkDataObject*> leaves;
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(blocks->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    if (!IsEmpty(leaf->GetCurrentDataObject()))
    {
      leaves.push_back(leaf->GetCurrentDataObject());
    }
  }
  return leaves;
}

template <class Data>
Result LeavesAs(vtkDataObject* data, const std::string& owner, const char* what,
                std::vector<Data*>& leaves)
{
  leaves.clear();
  for (vtkDataObject* leaf : LeavesOf(data))
  {
    auto* found = Data::SafeDownCast(leaf);
    if (found == nullptr && IsEmpty(leaf))
    {
      continue;
    }
    if (found == nullptr)
    {
      return Result::Error(owner + ": expected " + what + ", found a " + leaf->GetClassName() +
                           (leaf != data ? " among its blocks" : ""));
    }
    leaves.push_back(found);
  }
  return Result::Ok();
}

void AddMissing(vtkFieldData* from, vtkFieldData* to)
{
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = from->GetAbstractArray(i);
    if (array->GetName() != nullptr && !to->HasArray(array->GetName()))
    {
      to->AddArray(array);
    }
  }
}

const char* const Surface = "points, lines or a surface (vtkPolyData: Extract Surface makes one)";

template <class Data>
Result OneOf(vtkDataObject* data, const std::string& owner, const char* what,
             vtkSmartPointer<Data>& one)
{
  std::vector<Data*> leaves;
  WAFT_RETURN_IF_FAILED(LeavesAs(data, owner, what, leaves));
  if (leaves.size() > 1)
  {
    return Result::Error(owner + ": expected one data set, found " + std::to_string(leaves.size()) +
                         " blocks that are not empty");
  }
  one = vtkSmartPointer<Data>::New();
  if (!leaves.empty())
  {
    one->ShallowCopy(leaves.front());
    AddMissing(data->GetFieldData(), one->GetFieldData());
  }
  return Result::Ok();
}

std::set<std::string> NamesOf(vtkFieldData* arrays)
{
  std::set<std::string> names;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    const char* name = arrays->GetArrayName(i);
    names.insert(name ? name : "");
  }
  return names;
}

// Appending keeps what all have: what one lacks would be lost without a word.
Result CheckArrays(vtkFieldData* first, vtkFieldData* other, const std::string& what)
{
  const std::set<std::string> of[2] = { NamesOf(first), NamesOf(other) };
  for (const int side : { 0, 1 })
  {
    for (const std::string& name : of[side])
    {
      if (of[1 - side].count(name) == 0)
      {
        return Result::Error(what + " `" + name + "` in all blocks, found it in some");
      }
    }
  }
  return Result::Ok();
}

Result CheckScene(vtkFieldData* first, vtkFieldData* other, const std::string& owner)
{
  for (const char* name : { names::Bounds, names::NumberOfFrames, names::FramesPerSecond })
  {
    vtkDataArray* a = first->GetArray(name);
    vtkDataArray* b = other->GetArray(name);
    bool isSame = a == nullptr || b == nullptr || a->GetNumberOfValues() == b->GetNumberOfValues();
    for (vtkIdType i = 0; isSame && a && b && i < a->GetNumberOfValues(); ++i)
    {
      isSame = a->GetVariantValue(i) == b->GetVariantValue(i);
    }
    if (!isSame)
    {
      return Result::Error(owner + ": expected blocks of one scene, found another `" + name +
                           "` in their field data");
    }
  }
  return Result::Ok();
}

void AddPartitions(vtkPartitionedDataSet* parts, vtkMultiBlockDataSet* blocks)
{
  for (unsigned int i = 0; i < parts->GetNumberOfPartitions(); ++i)
  {
    blocks->SetBlock(i, parts->GetPartitionAsDataObject(i));
  }
}

// A data set of one partition is that partition.
void AddMember(vtkPartitionedDataSetCollection* collection, unsigned int member,
               vtkMultiBlockDataSet* blocks)
{
  vtkPartitionedDataSet* parts = collection->GetPartitionedDataSet(member);
  vtkNew<vtkMultiBlockDataSet> several;
  vtkDataObject* block = several;
  if (parts != nullptr && parts->GetNumberOfPartitions() == 1)
  {
    block = parts->GetPartitionAsDataObject(0);
  }
  else if (parts != nullptr)
  {
    AddPartitions(parts, several);
  }
  blocks->SetBlock(member, block);
  if (collection->HasMetaData(member))
  {
    blocks->GetMetaData(member)->Copy(collection->GetMetaData(member));
  }
}

} // namespace

Result SurfacesOf(vtkDataObject* data, const std::string& owner,
                  std::vector<vtkPolyData*>& surfaces)
{
  return LeavesAs(data, owner, Surface, surfaces);
}

std::vector<vtkMTimeType> PointChanges(const std::vector<vtkPolyData*>& surfaces)
{
  std::vector<vtkMTimeType> changes;
  for (vtkPolyData* surface : surfaces)
  {
    changes.push_back(surface->GetNumberOfPoints() > 0 ? surface->GetPoints()->GetMTime() : 0);
  }
  return changes;
}

Result OneSurface(vtkDataObject* data, const std::string& owner,
                  vtkSmartPointer<vtkPolyData>& surface)
{
  return OneOf(data, owner, Surface, surface);
}

Result MergedSurface(vtkDataObject* data, const std::string& owner,
                     vtkSmartPointer<vtkPolyData>& surface)
{
  std::vector<vtkPolyData*> leaves;
  WAFT_RETURN_IF_FAILED(SurfacesOf(data, owner, leaves));
  if (leaves.size() < 2)
  {
    return OneSurface(data, owner, surface);
  }
  vtkPolyData* first = leaves.front();
  vtkNew<vtkFieldData> fields;
  AddMissing(data->GetFieldData(), fields);
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* leaf : leaves)
  {
    WAFT_RETURN_IF_FAILED(CheckArrays(first->GetPointData(), leaf->GetPointData(),
                                      owner + ": expected the point data array"));
    WAFT_RETURN_IF_FAILED(CheckArrays(first->GetCellData(), leaf->GetCellData(),
                                      owner + ": expected the cell data array"));
    WAFT_RETURN_IF_FAILED(CheckScene(fields, leaf->GetFieldData(), owner));
    AddMissing(leaf->GetFieldData(), fields);
    vtkNew<vtkPolyData> own; // the block itself stays out of another pipeline
    own->ShallowCopy(leaf);
    append->AddInputData(own);
  }
  append->Update();
  fields->RemoveArray(names::Authored); // it tells of one block alone
  surface = append->GetOutput();
  surface->SetFieldData(fields);
  return Result::Ok();
}

Result OneImage(vtkDataObject* data, const std::string& owner, vtkSmartPointer<vtkImageData>& image)
{
  return OneOf(data, owner, "an image (vtkImageData)", image);
}

Result ListOfBlocks(vtkDataObject* data, const std::string& owner,
                    vtkSmartPointer<vtkMultiBlockDataSet>& blocks)
{
  blocks = vtkMultiBlockDataSet::SafeDownCast(data);
  if (auto* parts = vtkPartitionedDataSet::SafeDownCast(data))
  {
    blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    AddPartitions(parts, blocks);
  }
  else if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(data))
  {
    blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
    {
      AddMember(collection, i, blocks);
    }
  }
  if (blocks == nullptr)
  {
    return Result::Error(owner + ": expected a list of blocks (vtkMultiBlockDataSet), found a " +
                         data->GetClassName());
  }
  while (blocks->GetNumberOfBlocks() == 1 &&
         vtkMultiBlockDataSet::SafeDownCast(blocks->GetBlock(0)) != nullptr)
  {
    blocks = vtkMultiBlockDataSet::SafeDownCast(blocks->GetBlock(0));
  }
  return Result::Ok();
}

} // namespace waft
